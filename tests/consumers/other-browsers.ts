import { type ChildProcess, spawn, spawnSync } from "node:child_process";
import { once } from "node:events";
import { existsSync, mkdtempSync, readdirSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

import type { Answered, Consumer } from "./consumer";
import { consumers } from "./install";
import { importMap, module } from "./pages";
import { html, serve } from "./serve";

/** A browser that is only started with an address. Its pages send their answer to the server. */
interface Browser {
  name: string;
  command: (profile: string) => string[];
  /** Its version, or undefined if it is not installed. */
  version: string | undefined;
}

const CORS = { "access-control-allow-origin": "*" };

/** The other two engines, if they are installed. */
export const otherBrowsers: Consumer[] = [firefox(), webkit()].flatMap((browser) => [
  consumer(browser, "", async (sendTo, onSent) => serve(consumers, { pages: pagesFor("/", sendTo), onSent })),
  consumer(browser, ", a CDN", async (sendTo, onSent, cdn) =>
    serve(consumers, { refused: /node_modules/, pages: pagesFor(cdn, sendTo), onSent }),
  ),
]);

type Serve = (sendTo: string, onSent: (text: string) => void, cdn: string) => ReturnType<typeof serve>;

function consumer({ name, command, version }: Browser, how: string, open: Serve): Consumer {
  return {
    name: `${name}${how}`,
    further: true,
    version: version ?? "",
    ...(version === undefined ? { lacking: `there is no ${name} here` } : {}),
    run: async () => {
      const profile = mkdtempSync(join(tmpdir(), "hpr-browser-"));
      let child: ChildProcess | undefined;
      try {
        await using cdn = await serve(consumers, { headers: CORS });
        let sent: (text: string) => void = () => undefined;
        const answered = new Promise<string>((resolve) => (sent = resolve));
        await using site = await open("answer", sent, cdn.address);
        const [program = "", ...args] = command(profile);
        // A process group of its own, so that all its child processes end with it.
        child = spawn(program, [...args, `${site.address}index.html`], { stdio: "ignore", detached: true });
        return JSON.parse(await within(60_000, answered)) as Answered;
      } finally {
        if (child !== undefined) await end(child);
        rmSync(profile, { recursive: true, force: true, maxRetries: 5 });
      }
    },
  };
}

/** Ends the browser. Tries SIGTERM first, because a virtual screen that is killed leaves its lock behind. */
async function end(child: ChildProcess): Promise<void> {
  const ended = once(child, "exit");
  process.kill(-child.pid!, "SIGTERM");
  await within(10_000, ended).catch(() => process.kill(-child.pid!, "SIGKILL"));
}

function pagesFor(origin: string, sendTo: string): Record<string, string> {
  return { "index.html": html(importMap(origin) + module("app/main.js"), sendTo) };
}

async function within<T>(milliseconds: number, promise: Promise<T>): Promise<T> {
  let timer: NodeJS.Timeout | undefined;
  const late = new Promise<never>((_, reject) => {
    timer = setTimeout(() => {
      reject(new Error("no answer"));
    }, milliseconds);
  });
  return Promise.race([promise, late]).finally(() => {
    clearTimeout(timer);
  });
}

function firefox(): Browser {
  const name = ["firefox", "firefox-esr"].find((one) => versionOf(one) !== undefined) ?? "firefox";
  const command = (profile: string) => [name, "--headless", "--no-remote", "--profile", profile];
  return { name: "Firefox", command, version: versionOf(name) };
}

/** WebKit for GTK includes a small browser. It needs a screen, but a virtual one is enough. */
function webkit(): Browser {
  const libraries = "/usr/lib/x86_64-linux-gnu";
  const folder = existsSync(libraries) ? readdirSync(libraries).find((one) => /^webkit2gtk-4/.test(one)) : undefined;
  const command = ["xvfb-run", "--auto-servernum", join(libraries, folder ?? "", "MiniBrowser")];
  return {
    name: "WebKitGTK",
    command: () => command,
    version: folder === undefined ? undefined : versionOf(...command),
  };
}

function versionOf(program = "", ...args: string[]): string | undefined {
  const { stdout, status } = spawnSync(program, [...args, "--version"], { encoding: "utf8", timeout: 20_000 });
  return status === 0 ? (/\d+(\.\d+)+/.exec(stdout)?.[0] ?? "") : undefined;
}
