import { Message } from "../panel/message.ts";
import { Turning } from "../view/moves.ts";
import { Opening } from "./opening.ts";
import { byId } from "../controls/controls.ts";
import { spokenKeys } from "../controls/keys.ts";
import { forgetAhead } from "../loaders/index.ts";
import { Panel } from "../panel/panel.ts";
import { sampleNamed } from "../samples/samples.ts";
import { Address, type CameraPlace, type AddressParameters } from "../settings/address.ts";
import { Store, USUAL_SETTINGS } from "../settings/settings.ts";
import type { StoryName } from "../settings/table.ts";
import type { ExportActions } from "../tools/export.ts";
import { Workshop } from "../tools/workshop.ts";
import type { AskedView } from "../view/framing.ts";
import { canDraw } from "../view/theme.ts";
import { Viewer } from "../view/viewer.ts";
import { Introduction, Storytelling } from "./storytelling.ts";
import { Notices, sentenceOf } from "./notices.ts";
import { fromFiles, limitsOf, onFile, type Source } from "./sources.ts";
import { Status } from "./status.ts";

/** Makes the parts of the page, and opens the first cloud in them. Without WebGL 2, says so. Resolves when it is open. */
export async function startSession(asked: AddressParameters, first: Source): Promise<void> {
  const status = new Status(byId("status"));
  const message = new Message();
  byId("view").ariaLabel = `Point cloud. ${spokenKeys(["orbit", "pan", "zoom", "pick", "sheet"])}.`;
  if (!canDraw(byId("view", HTMLCanvasElement))) {
    const sentence = "This page draws with WebGL 2, which this browser does not offer or has switched off.";
    status.error(sentence);
    message.show(sentence);
    forgetAhead();
    return;
  }
  const settings = { ...USUAL_SETTINGS, ...asked.settings };
  // Places in space belong to a cloud, and are set with the cloud.
  const store = new Store({ ...settings, freeze: null });
  const viewer = new Viewer(byId("view", HTMLCanvasElement), store, false, coveredHeight);
  new ResizeObserver(() => viewer.stage.refit()).observe(byId("verbs"));
  const turning = new Turning(viewer);
  const introduction = new Introduction(viewer, store, turning, asked.isFirst);
  const panel = new Panel(viewer, store, settings, turning);
  const notices = new Notices(status, message);
  const address: Address = new Address(store, {
    camera: () => cameraPlace(viewer, opening.askedView),
    marks: () => workshop.marks,
    isOwn: () => introduction.going || storytelling.isTelling,
  });
  const actions = {
    name: () => opening.shownName,
    link: () => address.link(),
    changed: () => address.touch(),
  };
  const workshop: Workshop = new Workshop(viewer, store, actions);
  const parts = { viewer, store, panel, address, workshop, status, message, notices };
  const opening: Opening = new Opening(parts, sampleNamed(asked.sample));
  const storytelling: Storytelling = new Storytelling({ viewer, store, address, workshop, opening });
  viewer.onFrame = () => workshop.tools?.place();
  viewer.onAttributes = (cloud) => panel.prepare(cloud);
  viewer.stage.onCamera = () => {
    // While another cloud is being read, the camera is not where the address says.
    if (viewer.cloud) address.touch();
  };
  viewer.stage.onLost = () => {
    message.show(
      "The browser has taken the picture away to save memory; it is drawn again as soon as the browser allows, or when you reload the page.",
    );
  };
  viewer.stage.onRestored = () => message.hide();
  store.follow((now) => status.describe(now.freeze !== null));
  viewer.onAnswer = (answer, total) => {
    panel.follow(answer);
    workshop.tools?.follow();
    status.answer(answer, total, store.current.freeze !== null);
    notices.tell(answer.note);
  };
  viewer.onMap = (mapped) => status.map(mapped);
  viewer.onBusy = (busy, byMap) => {
    status.busy(busy);
    // A picture that turns by itself is never up to date, and nobody waits for it.
    byId("sign-work").hidden = !busy || byMap || turning.isOn;
  };
  viewer.onError = (error) => notices.refuseView(error);

  onFile({
    open: (files, notes) => void opening.open(fromFiles(files, notes, limitsOf(asked))),
    refuse: (sentence) => message.show(sentence),
  });
  store.follow(({ surface, thickness, looks }, before) => {
    if (surface !== before.surface || thickness !== before.thickness || looks !== before.looks) opening.say();
  });
  bindLessons(viewer, store, storytelling, message, actions);
  const opened = asked.story ? storytelling.tell(asked.story) : opening.open(first);
  await opened;
  if (!asked.story) void introduction.begin(asked.turns);
}

/** The height at the bottom of the picture that the verbs or the tools cover, in CSS pixels. A corner does not count. */
function coveredHeight(): number {
  const { bottom, width } = byId("view").getBoundingClientRect();
  const heights = ["verbs", "tool-card", "tool-bar"].map((id) => {
    const box = byId(id).getBoundingClientRect();
    return box.width > 0.75 * width ? bottom - box.top : 0;
  });
  return Math.max(0, ...heights);
}

/** The lesson, the judgment, the code and the stories. Each is downloaded when it is asked for. */
function bindLessons(
  viewer: Viewer,
  store: Store,
  storytelling: Storytelling,
  message: Message,
  { name, link }: ExportActions,
): void {
  let isComing = false;
  const bind = (selector: string, what: string, show: (button: HTMLElement) => Promise<void>) => {
    for (const button of document.querySelectorAll<HTMLElement>(selector)) {
      button.addEventListener("click", () => {
        // The second click of a double click.
        if (isComing) return;
        isComing = true;
        show(button)
          .catch((error: unknown) => message.show(sentenceOf(error, `${what} could not be shown`)))
          .finally(() => (isComing = false));
      });
    }
  };
  bind(".how", "The lesson", async () => {
    await (await import("../how/how.ts")).showHow();
  });
  bind(".right", "The judgment", async () => {
    if (viewer.cloud) await (await import("../right/right.ts")).showRight(viewer);
  });
  bind(".use", "The code", async () => {
    if (viewer.cloud) (await import("../tools/use.ts")).showUse(viewer, store, name(), link());
  });
  bind("[data-story]", "The story", (button) => storytelling.tell(button.dataset["story"] as StoryName));
}

/** The camera's place for the address. `null` at the first view, unless the address asked for that view. */
function cameraPlace(viewer: Viewer, asked: AskedView | null): CameraPlace | null {
  if (!viewer.cloud) return null;
  if (viewer.isHome && viewer.isTargetHome) return asked && { view: asked.at, target: asked.target };
  return { view: viewer.viewpoint, target: viewer.target };
}
