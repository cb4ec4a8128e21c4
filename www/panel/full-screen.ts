import { byId } from "../controls/dom.ts";

/** The button for the cloud on the whole screen, where the browser can; the returned function does the same. */
export function bindFullScreen(): () => void {
  const button = byId("full-screen", HTMLButtonElement);
  if (!document.fullscreenEnabled) return () => undefined;
  button.hidden = false;
  const toggle = () => {
    const done = document.fullscreenElement ? document.exitFullscreen() : document.documentElement.requestFullscreen();
    // Where the browser refuses, the page stays as it is, as one sees.
    done.catch(() => undefined);
  };
  button.addEventListener("click", toggle);
  document.addEventListener("fullscreenchange", () => {
    button.setAttribute("aria-pressed", String(document.fullscreenElement !== null));
  });
  return toggle;
}
