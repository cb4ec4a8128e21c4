import { show } from "../app/show.js";

const worker = new Worker(new URL("./module-worker.js", import.meta.url), { type: "module" });
void show(
  new Promise((resolve, reject) => {
    worker.onmessage = ({ data }) => resolve(data);
    worker.onerror = reject;
  }),
);
