import { byId } from "../controls/dom.ts";
import { remember, remembered } from "../controls/memory.ts";
import type { Store } from "../settings/store.ts";
import type { Viewer } from "../view/viewer.ts";

/** The name under which this device remembers that the guide was seen or skipped. */
const REMEMBERED = "guide";
/** Each of the four steps takes this number of milliseconds. */
const STEP = 5000;
/** Radians in a millisecond, in the step that walks around. */
const SPEED = 0.0004;

interface Step {
  words: string;
  /** Sets the picture up. */
  begin: () => void;
  /** Whether the camera walks around the cloud. */
  walks?: boolean;
}

/** Offers a guide of 20 seconds at the first visit. It ends as soon as the user does something else. */
export function offerGuide(viewer: Viewer, store: Store): void {
  if (remembered(REMEMBERED) !== null) return;
  const card = document.createElement("div");
  card.id = "guide";
  card.role = "group";
  card.ariaLabel = "Guide";
  const words = document.createElement("p");
  words.role = "status";
  words.textContent = "New here? See what this page shows, in 20 seconds.";
  const next = button("Show me");
  const skip = button("Skip");
  const buttons = document.createElement("div");
  buttons.className = "buttons";
  buttons.append(next, skip);
  card.append(words, buttons);
  byId("tools").prepend(card);

  const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
  const steps = stepsOf(viewer, store);
  const over = new AbortController();
  let at = -1;
  let timer: ReturnType<typeof setTimeout> | undefined;
  const show = () => {
    clearTimeout(timer);
    const step = steps[++at];
    if (!step) {
      end();
      return;
    }
    step.begin();
    words.textContent = step.words;
    next.textContent = at < steps.length - 1 ? "Next" : "Done";
    timer = setTimeout(show, STEP);
    if (step.walks && !calm) walk(viewer, () => steps[at] === step && !over.signal.aborted);
  };
  const end = () => {
    clearTimeout(timer);
    over.abort();
    remember(REMEMBERED, "seen");
    // The focus must not vanish with the button.
    if (card.contains(document.activeElement)) byId("view").focus();
    card.remove();
  };
  next.addEventListener("click", show);
  skip.addEventListener("click", () => {
    if (at >= 0) leave(viewer, store);
    end();
  });
  for (const [place, event] of [
    ["view", "pointerdown"],
    ["view", "keydown"],
    ["tool-bar", "click"],
    ["panel", "click"],
  ] as const) {
    byId(place).addEventListener(event, end, { signal: over.signal });
  }
}

function stepsOf(viewer: Viewer, store: Store): Step[] {
  return [
    {
      words:
        "On the left are all points, as any viewer draws them. On the right are only those that can be seen from here.",
      begin: () => {
        store.change({ compare: 0.5 });
      },
    },
    {
      words: "The purple points cannot be seen from here. They are drawn through the others.",
      begin: () => {
        store.change({ compare: null, hidden: "shown" });
      },
    },
    {
      words: "Now the viewpoint is frozen and the camera walks around. Gaps are places that could not be seen.",
      begin: () => {
        store.change({ hidden: "off", freeze: viewer.viewpoint });
      },
      walks: true,
    },
    {
      words: "Your turn: drag to look around. The visible points follow. You can also open your own file.",
      begin: () => {
        leave(viewer, store);
      },
    },
  ];
}

/** Puts everything back that the guide has changed. */
function leave(viewer: Viewer, store: Store): void {
  store.change({ compare: null, hidden: "off", freeze: null });
  viewer.reset();
}

function walk(viewer: Viewer, goesOn: () => boolean): void {
  let last = performance.now();
  const step = (now: number) => {
    if (!goesOn() || !viewer.cloud) return;
    viewer.navigation.turn(SPEED * Math.min(100, Math.max(0, now - last)));
    last = now;
    requestAnimationFrame(step);
  };
  requestAnimationFrame(step);
}

function button(label: string): HTMLButtonElement {
  const made = document.createElement("button");
  made.type = "button";
  made.textContent = label;
  return made;
}
