// A server component, rendered for every request: the answer of the server, and of workers that it starts.
import * as hpr from "hidden-point-removal";
import * as lite from "hidden-point-removal/lite";
import * as worker from "hidden-point-removal/worker";
import { answerWithLite } from "../shared/answer.js";
import { InBrowser } from "./in-browser";

export const dynamic = "force-dynamic";

export default async function Page() {
  return <InBrowser server={await answerWithLite(hpr, worker, lite)} />;
}
