// What the page's own thread does, by Chromium's trace of it.
import type { Browser, Page } from "playwright-core";

/** One turn of the thread: nothing else, no input and no frame, gets between its parts. In milliseconds. */
export interface Task {
  start: number;
  wall: number;
  /** What the thread itself computed; waiting for other threads, for the graphics process or for its core is not in it. */
  cpu: number;
  /** What of that ran in JavaScript. */
  script: number;
  /** What it was for, in the words of the trace. */
  what: string;
}

export interface Trace {
  tasks: Task[];
  /** When each frame of the page began. */
  frames: number[];
}

interface Event {
  name: string;
  ph: string;
  pid: number;
  tid: number;
  ts: number;
  dur?: number;
  tdur?: number;
  args: { name?: string; data?: { functionName?: string; type?: string } };
}

const CATEGORIES = [
  "-*",
  "devtools.timeline",
  "disabled-by-default-devtools.timeline",
  "v8",
  "v8.execute",
  "blink.user_timing",
];
/** JavaScript that the thread begins to run, whatever for. */
const SCRIPT = new Set([
  "FunctionCall",
  "EvaluateScript",
  "v8.evaluateModule",
  "v8.compile",
  "v8.compileModule",
  "RunMicrotasks",
  "EventDispatch",
  "FireAnimationFrame",
  "TimerFire",
  "MinorGC",
  "MajorGC",
  "V8.GCScavenger",
  "V8.DeserializeMessage",
]);

/** Traces the page while `action` runs. */
export async function traced(browser: Browser, page: Page, action: () => Promise<void>): Promise<Trace> {
  await browser.startTracing(page, { categories: CATEGORIES });
  let file: Buffer;
  try {
    await action();
  } finally {
    file = await browser.stopTracing();
  }
  const { traceEvents } = JSON.parse(file.toString("utf8")) as { traceEvents: Event[] };
  return read(traceEvents);
}

function read(events: Event[]): Trace {
  const parts = ofThePage(events)
    .filter(({ ph }) => ph === "X")
    .sort((a, b) => a.ts - b.ts || (b.dur ?? 0) - (a.dur ?? 0));
  const tasks = parts.filter(({ name }) => name === "RunTask");
  let next = 0;
  return {
    tasks: tasks.map((task) => {
      const end = task.ts + (task.dur ?? 0);
      while (next < parts.length && parts[next]!.ts < task.ts) next++;
      const inside: Event[] = [];
      for (let i = next; i < parts.length && parts[i]!.ts < end; i++) if (parts[i] !== task) inside.push(parts[i]!);
      return taskOf(task, inside);
    }),
    frames: parts.filter(({ name }) => name === "FireAnimationFrame").map(({ ts }) => ts / 1000),
  };
}

/** The browser has other pages' threads, too; none of them draws frames. */
function ofThePage(events: Event[]): Event[] {
  const threads = events.filter(({ name, args }) => name === "thread_name" && args.name === "CrRendererMain");
  const all = threads.map((thread) => events.filter(({ pid, tid }) => pid === thread.pid && tid === thread.tid));
  const frames = (own: Event[]) => own.filter(({ name }) => name === "FireAnimationFrame").length;
  if (all.length === 0) throw new Error("The trace does not tell which thread is the page's.");
  return all.reduce((a, b) => (frames(b) > frames(a) ? b : a));
}

function taskOf(task: Event, inside: Event[]): Task {
  let script = 0;
  let until = -Infinity;
  for (const part of inside) {
    // Only the outermost: what runs within is part of it.
    if (!SCRIPT.has(part.name) || part.ts < until) continue;
    until = part.ts + (part.dur ?? 0);
    script += part.tdur ?? part.dur ?? 0;
  }
  const longest = inside.toSorted((a, b) => (b.tdur ?? 0) - (a.tdur ?? 0)).slice(0, 3);
  const what = longest
    .map(({ name, args }) => [name, args.data?.type ?? args.data?.functionName].filter(Boolean).join(" "))
    .join(", ");
  return {
    start: task.ts / 1000,
    wall: (task.dur ?? 0) / 1000,
    cpu: (task.tdur ?? task.dur ?? 0) / 1000,
    script: script / 1000,
    what,
  };
}
