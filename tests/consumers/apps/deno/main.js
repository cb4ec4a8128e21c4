import * as hpr from "hidden-point-removal";
import * as lite from "hidden-point-removal/lite";
import * as worker from "hidden-point-removal/worker";
import { answerWithLite } from "./shared/answer.js";

console.log(JSON.stringify(await answerWithLite(hpr, worker, lite)));
