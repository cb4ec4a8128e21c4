import * as hpr from "hidden-point-removal";
// The loader "file" gives the address of a copy beside the bundle.
import wasm from "hidden-point-removal/hpr.wasm";
import * as worker from "hidden-point-removal/worker";
import { answer } from "../app/answer.js";
import { show } from "../app/show.js";

void show(answer(hpr, worker, new URL(wasm, import.meta.url)));
