// npm start: builds, then serves the demo page until it is stopped. PORT sets the port.
// Changes to the page show at once. Changes to the package show after a restart.
import { createServer } from "vite";

import { Problem, inRoot } from "./lib/run.js";
import { buildPackage } from "./build/build.js";

export async function start(): Promise<void> {
  const { port, asked } = chosenPort();
  await buildPackage();
  // A port from PORT is used or refused. The usual port may give way to the next one.
  // The host is a number, because with `localhost` some systems would listen on IPv6 only.
  const settings = { host: "127.0.0.1", port, strictPort: asked };
  const server = await createServer({ root: inRoot("www"), configLoader: "runner", server: settings });
  try {
    await server.listen();
  } catch (error) {
    await server.close();
    throw new Problem(`The page cannot be served: ${String(error)}`);
  }
  stopWithNpm();
  console.log(`\nThe demo page: http://localhost:${server.config.server.port}/ (Ctrl+C stops it)`);
}

/** Ending npm ends the shell that runs its scripts, but not the programs in that shell. */
function stopWithNpm(): void {
  if (process.env["npm_lifecycle_event"] === undefined) return;
  const parent = process.ppid;
  setInterval(() => {
    if (process.ppid !== parent) process.exit();
  }, 500).unref();
}

function chosenPort(): { port: number; asked: boolean } {
  const text = process.env["PORT"] ?? "";
  if (text === "") return { port: 5173, asked: false };
  const port = Number(text);
  if (Number.isInteger(port) && port > 0 && port < 65536) return { port, asked: true };
  throw new Problem(`PORT is ${text}, which is no port number (1 to 65535).`);
}
