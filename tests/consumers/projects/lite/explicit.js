import * as lite from "hidden-point-removal/lite";
// The loader "file" gives the address of a copy beside the bundle.
import wasm from "hidden-point-removal/lite/hpr.wasm";
import { answerHere } from "../app/answer.js";
import { show } from "../app/show.js";

void show(answerHere(lite, new URL(wasm, import.meta.url)));
