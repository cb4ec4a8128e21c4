import * as hpr from "hidden-point-removal";
import * as worker from "hidden-point-removal/worker";
import { answer } from "./shared/answer.js";
import { show } from "./shared/show.js";

void show(answer(hpr, worker));
