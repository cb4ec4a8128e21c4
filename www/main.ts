import { byId } from "./controls/dom.ts";
import { startSession } from "./page/session.ts";
import { Status } from "./page/status.ts";
import { showEmbedded } from "./panel/embedded.ts";
import { Message } from "./panel/message.ts";
import { bindSheet } from "./panel/sheet.ts";
import { SAMPLES } from "./samples/samples.ts";
import { readAddress } from "./settings/read-address.ts";
import { canDraw } from "./view/stage.ts";

const wishes = readAddress(
  location.search,
  SAMPLES.map((sample) => sample.name),
);
if (wishes.embed) showEmbedded();
const status = new Status(byId("status"));
const message = new Message();
bindSheet();

if (canDraw(byId("view", HTMLCanvasElement))) {
  startSession(wishes, status, message);
} else {
  const sentence = "This page draws with WebGL 2, which this browser does not offer or has switched off.";
  status.error(sentence);
  message.show(sentence);
}
