import { readable } from "../settings/address.ts";
import { byId } from "../controls/dom.ts";

/** For a frame in another page: shows the picture alone, and a link to the whole page in its present state. */
export function showEmbedded(): void {
  document.body.classList.add("embedded");
  const link = byId("whole-page", HTMLAnchorElement);
  link.hidden = false;
  const follow = () => {
    const address = new URL(location.href);
    address.searchParams.delete("embed");
    link.href = readable(address).href;
  };
  follow();
  // The address follows the camera and the settings.
  for (const event of ["pointerdown", "focus", "click"]) link.addEventListener(event, follow);
}
