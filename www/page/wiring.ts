import type { Signs } from "../panel/signs.ts";
import type { Turning } from "../view/turning.ts";
import type { Parts } from "./opening.ts";

/** Connects the parts of the page: the viewer draws and asks, and the other parts follow it. */
export function wire({
  viewer,
  store,
  panel,
  signs,
  address,
  workshop,
  status,
  message,
  notices,
  turning,
}: Parts & { signs: Signs; turning: Turning }): void {
  viewer.onFrame = () => workshop.place();
  viewer.onDetail = () => workshop.exchange();
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
    workshop.answer();
    status.answer(answer, total, store.current.freeze !== null);
    notices.tell(answer.note);
  };
  viewer.onMap = (mapped) => status.map(mapped);
  viewer.onBusy = (busy, byMap) => {
    status.busy(busy);
    // A picture that turns by itself is never up to date, and nobody waits for it.
    signs.busy(busy && !byMap && !turning.isOn);
  };
  viewer.onError = (error) => {
    notices.refuseView(error, () => viewer.restart());
  };
}
