/** Fills the screen with the page, or ends that, if the browser supports it. */
export function toggleFullScreen(): void {
  if (!document.fullscreenEnabled) return;
  const done = document.fullscreenElement ? document.exitFullscreen() : document.documentElement.requestFullscreen();
  // If the browser refuses, the page stays as it is, and the user sees that.
  done.catch(() => undefined);
}
