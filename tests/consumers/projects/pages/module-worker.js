// The whole package inside the page's own worker, which starts further workers.
import * as hpr from "../../node_modules/hidden-point-removal/dist/index.js";
import * as worker from "../../node_modules/hidden-point-removal/dist/worker.js";
import { answer } from "../app/answer.js";

answer(hpr, worker).then(
  (answered) => postMessage(answered),
  (error) => postMessage({ error: String(error) }),
);
