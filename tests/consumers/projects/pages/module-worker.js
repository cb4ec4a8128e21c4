// The whole package inside a worker of the page's own, which starts workers in turn.
import * as hpr from "../../node_modules/hidden-point-removal/dist/index.js";
import * as worker from "../../node_modules/hidden-point-removal/dist/worker.js";
import { answer } from "../app/answer.js";

answer(hpr, worker).then(
  (answered) => postMessage(answered),
  (error) => postMessage({ error: String(error) }),
);
