import { init, PointCloud } from "hidden-point-removal/lite";
import { answerHere } from "../app/answer.js";
import { show } from "../app/show.js";

void show(answerHere({ init, PointCloud }));
