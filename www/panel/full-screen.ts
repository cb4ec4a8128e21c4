import { byId } from "../controls/dom.ts";

/** The button for full screen, if the browser supports it. The returned function does the same as the button. */
export function bindFullScreen(): () => void {
  const button = byId("full-screen", HTMLButtonElement);
  if (!document.fullscreenEnabled) return () => undefined;
  button.hidden = false;
  const toggle = () => {
    const done = document.fullscreenElement ? document.exitFullscreen() : document.documentElement.requestFullscreen();
    // If the browser refuses, the page stays as it is, and the user sees that.
    done.catch(() => undefined);
  };
  button.addEventListener("click", toggle);
  document.addEventListener("fullscreenchange", () => {
    button.setAttribute("aria-pressed", String(document.fullscreenElement !== null));
  });
  return toggle;
}
