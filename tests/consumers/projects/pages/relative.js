import * as hpr from "../../node_modules/hidden-point-removal/dist/index.js";
import * as worker from "../../node_modules/hidden-point-removal/dist/worker.js";
import { answer } from "../app/answer.js";
import { show } from "../app/show.js";

void show(answer(hpr, worker));
