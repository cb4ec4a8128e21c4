import * as hpr from "hidden-point-removal";
import * as lite from "hidden-point-removal/lite";
import * as worker from "hidden-point-removal/worker";
import { answerWithLite } from "./shared/answer.js";
import { show } from "./shared/show.js";

void show(answerWithLite(hpr, worker, lite));
