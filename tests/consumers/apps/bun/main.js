import * as hpr from "hidden-point-removal";
import * as worker from "hidden-point-removal/worker";
import { answer } from "./shared/answer.js";

console.log(JSON.stringify(await answer(hpr, worker)));
