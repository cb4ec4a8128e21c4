// A page that is rendered when the site is built.
import * as hpr from "hidden-point-removal";
import { answerHere } from "../../shared/answer.js";
import { InBrowser } from "../in-browser";

export default async function Page() {
  return <InBrowser server={await answerHere(hpr)} />;
}
