import { byId } from "./controls/dom.ts";
import { showEmbedded } from "./panel/embedded.ts";
import { Message } from "./panel/message.ts";
import { bindSheet } from "./panel/sheet.ts";
import { readParams } from "./settings/params.ts";
import { SAMPLES } from "./samples/samples.ts";
import { startSession } from "./page/session.ts";
import { Status } from "./page/status.ts";
import { canDraw } from "./view/stage.ts";

const params = readParams(
  location.search,
  SAMPLES.map((sample) => sample.name),
);
if (params.embed) showEmbedded();
const status = new Status(byId("status"));
const message = new Message();
bindSheet();

if (canDraw(byId("view", HTMLCanvasElement))) {
  startSession(params, status, message);
} else {
  const sentence = "This page draws with WebGL 2, which this browser does not offer or has switched off.";
  status.error(sentence);
  message.show(sentence);
}
