// Each format in a worker of a page: the answer, no rejection that nobody takes, and no request but for the package's own files.
import { readCloud } from "hidden-point-removal/files";
import { beforeAll, expect, test } from "vitest";

import { eachFormat } from "../files/valid";
import { modulesPage } from "./modules-page";

const shared = modulesPage({ "hidden-point-removal/files": "/dist/files.js" });
const requests: string[] = [];

beforeAll(() => {
  shared.page.on("request", (request) => requests.push(request.url()));
});

test.each(Object.entries(eachFormat()))("%s", async (name, content) => {
  const bytes = [...Buffer.from(content)];
  const here = await readCloud(new File([Uint8Array.from(bytes)], name)).then(
    ({ positions }) => [...positions],
    (error: unknown) => [(error as { code: string }).code],
  );
  const there = await shared.page.evaluate(
    async ({ name, bytes }) => {
      const script = `
        import { readCloud } from "${location.origin}/dist/files.js";
        addEventListener("unhandledrejection", () => postMessage(["unhandled"]));
        onmessage = ({ data }) => readCloud(data).then(
          ({ positions }) => postMessage([...positions]), (error) => postMessage([error.code]));
        postMessage("ready");`;
      const worker = new Worker(URL.createObjectURL(new Blob([script], { type: "text/javascript" })), {
        type: "module",
      });
      const said = () => new Promise((resolve) => (worker.onmessage = ({ data }) => resolve(data)));
      await said();
      worker.postMessage(new File([Uint8Array.from(bytes)], name));
      const answer = await said();
      worker.terminate();
      return answer;
    },
    { name, bytes },
  );
  expect(there).toEqual(here);
  expect(requests.filter((url) => !/\/dist\/|^blob:/.test(url))).toEqual([]);
});
