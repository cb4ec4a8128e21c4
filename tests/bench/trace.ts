// The tasks of the page's own thread, from Chromium's trace.
import type { Browser, Page } from "playwright-core";

/** One task of the thread, in milliseconds. No input and no frame comes between its parts. */
export interface Task {
  start: number;
  wall: number;
  /** CPU time of the thread itself, without waiting for other threads, the graphics process or a core. */
  cpu: number;
  /** The part of it in JavaScript. */
  script: number;
  /** The purpose, in the words of the trace. */
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
/** Events at which the thread begins to run JavaScript. */
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

/** The thread that draws frames. The browser has threads of other pages, too, but they draw none. */
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
    // Only the outermost event counts. It includes the events inside it.
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
