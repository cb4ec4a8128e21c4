// A server component, rendered for every request: the answer of the server, and of workers that it starts.
import * as hpr from "hidden-point-removal";
import * as worker from "hidden-point-removal/worker";
import { answer } from "../shared/answer.js";
import { InBrowser } from "./in-browser";

export const dynamic = "force-dynamic";

export default async function Page() {
  return <InBrowser server={await answer(hpr, worker)} />;
}
