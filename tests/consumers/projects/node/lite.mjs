import * as lite from "hidden-point-removal/lite";
import { answerHere } from "../app/answer.js";

console.log(JSON.stringify(await answerHere(lite)));
