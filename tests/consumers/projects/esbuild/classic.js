// Everything in one classic script: the wasm and the worker, too.
import * as hpr from "hidden-point-removal/inline";
import * as worker from "hidden-point-removal/worker";
import { answer } from "../app/answer.js";
import { show } from "../app/show.js";

void show(answer(hpr, worker));
