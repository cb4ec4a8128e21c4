import * as hpr from "hidden-point-removal";
import * as worker from "hidden-point-removal/worker";
import { answer } from "./answer.js";
import { show } from "./show.js";

void show(answer(hpr, worker));
