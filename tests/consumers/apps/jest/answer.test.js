import { writeFileSync } from "node:fs";
import * as hpr from "hidden-point-removal";
import * as lite from "hidden-point-removal/lite";
import * as worker from "hidden-point-removal/worker";
import { answerWithLite } from "./shared/answer.js";

test("answers in jsdom", async () => {
  expect(document.body).toBeDefined();
  writeFileSync("answer.json", JSON.stringify(await answerWithLite(hpr, worker, lite)));
});
