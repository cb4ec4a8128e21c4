import * as hpr from "hidden-point-removal";
import * as worker from "hidden-point-removal/worker";
import { answer } from "../app/answer.js";
import { show } from "../app/show.js";

hpr.configure({ wasm: "hpr.wasm", worker: "worker-thread.js" });
void show(answer(hpr, worker));
