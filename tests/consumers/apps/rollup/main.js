import * as hpr from "hidden-point-removal";
import * as lite from "hidden-point-removal/lite";
import * as worker from "hidden-point-removal/worker";
import { answerWithLite } from "./shared/answer.js";
import { show } from "./shared/show.js";

hpr.configure({ wasm: "hpr.wasm", worker: "worker-thread.js" });
void show(answerWithLite(hpr, worker, lite, "lite.wasm"));
