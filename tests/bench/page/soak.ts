// The memory and objects of the page after many answers and many clouds.
import type { Browser, CDPSession, Page } from "playwright-core";

import { type Holdings, holdingsOf, memoryOf } from "../../browser/holdings.js";
import type { Row, Table } from "../report.js";
import { answered, newContext, ready, upToDate, watchedPage } from "./visit.js";

const FIRST = 36;
const ANSWERS = 200;
/** The number of changes. Each change opens the room and then the dragon again. */
const CHANGES = 20;
const EVERY = { answers: 50, changes: 5 };
const MB = 1e6;

export async function soak(browser: Browser, address: string): Promise<Table> {
  const context = await newContext(browser);
  // Drawing by software would take most of the time and keeps no memory.
  const page = await watchedPage(context, false);
  await page.goto(`${address}?sample=dragon`);
  await ready(page);
  const rows: Row[] = [];
  const note = async (after: string) => {
    console.error(`dragon: ${after}…`);
    rows.push({ after, ...(await holds(page)) });
  };

  // One round before anything counts, so that objects made at first use exist.
  for (let i = 0; i < FIRST; i++) await step(page);
  await change(page, "room");
  await change(page, "dragon");
  await note(`${FIRST} answers and 2 clouds`);
  for (let i = 1; i <= ANSWERS; i++) {
    await step(page);
    if (i % EVERY.answers === 0) await note(`${i} answers more`);
  }
  for (let i = 1; i <= CHANGES; i++) {
    await change(page, "room");
    await change(page, "dragon");
    if (i % EVERY.changes === 0) await note(`${2 * i} clouds more`);
  }
  await context.close();
  return {
    title: "What the page holds",
    note:
      `The dragon, half around (${FIRST} steps of 5°), the room and the dragon again; then ${ANSWERS} more steps, each answered; then the room and the dragon in turn, ${CHANGES} times each. Draw calls are left out. ` +
      "Megabytes of JavaScript objects, of array buffers and of the workers' WebAssembly after garbage collection; nodes and listeners of the document; workers; objects of WebGL that were made and not deleted.",
    rows,
  };
}

/** One answer, drawn. */
async function step(page: Page): Promise<void> {
  await answered(page, () => page.locator("#view").press("ArrowLeft"));
}

async function change(page: Page, sample: string): Promise<void> {
  await answered(page, () => page.selectOption("#sample", sample));
  await page.locator("#progress").waitFor({ state: "hidden" });
  await upToDate(page);
  await page.waitForTimeout(500);
}

async function holds(page: Page): Promise<Row> {
  // The timers of the address and of the sentences have run.
  await page.waitForTimeout(1500);
  const { heap, buffers, nodes, listeners } = await memoryOf(page);
  const { workers, webgl }: Holdings = await holdingsOf(page);
  const shown = ["Buffer", "VertexArray", "Texture", "Program", "Shader", "Framebuffer", "Renderbuffer"].map(
    (kind) => webgl[kind],
  );
  return {
    "objects MB": heap / MB,
    "buffers MB": buffers / MB,
    "wasm MB": (await wasmOf(page)) / MB,
    nodes,
    listeners,
    workers,
    "WebGL buffers, vertex arrays, textures, programs, shaders, frame- and renderbuffers": shown.join(" "),
  };
}

/** The WebAssembly memory of all workers of the page. The debugger asks each worker. */
async function wasmOf(page: Page): Promise<number> {
  const session = await page.context().newCDPSession(page);
  const found: string[] = [];
  session.on("Target.attachedToTarget", ({ sessionId, targetInfo }) => {
    if (targetInfo.type === "worker") found.push(sessionId);
  });
  await session.send("Target.setAutoAttach", { autoAttach: true, waitForDebuggerOnStart: false, flatten: false });
  let bytes = 0;
  for (const worker of found) {
    const { result } = await send(session, worker, "Runtime.evaluate", { expression: "WebAssembly.Memory.prototype" });
    const { objects } = await send(session, worker, "Runtime.queryObjects", { prototypeObjectId: result.objectId });
    const sum = {
      objectId: objects.objectId,
      returnByValue: true,
      functionDeclaration: "function () { return this.reduce((sum, memory) => sum + memory.buffer.byteLength, 0); }",
    };
    bytes += (await send(session, worker, "Runtime.callFunctionOn", sum)).result.value;
  }
  await session.detach();
  return bytes;
}

interface Reply {
  result: { objectId: string; value: number };
  objects: { objectId: string };
}

/** Sends a command to a worker through its page's session. */
function send(session: CDPSession, worker: string, method: string, params: object): Promise<Reply> {
  const id = Math.floor(Math.random() * 1e9);
  return new Promise((resolve, reject) => {
    session.on("Target.receivedMessageFromTarget", ({ sessionId, message }) => {
      const reply = JSON.parse(message) as { id?: number; result?: Reply; error?: { message: string } };
      if (sessionId !== worker || reply.id !== id) return;
      if (reply.result) resolve(reply.result);
      else reject(new Error(`${method}: ${reply.error?.message ?? "no result"}`));
    });
    session
      .send("Target.sendMessageToTarget", { sessionId: worker, message: JSON.stringify({ id, method, params }) })
      .catch(reject);
  });
}
