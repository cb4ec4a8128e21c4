// npm run figures: the paper's figures, drawn by the demo page.
// Names after `--` choose some of them.
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

import { init } from "hidden-point-removal";

import { root } from "../root.js";
import { beforeAfter } from "./before-after.js";
import { errorPlot } from "./error-plot.js";
import type { Figure, Maker } from "./figure.js";
import { halo } from "./halo.js";
import { radius } from "./radius.js";
import { withFigures } from "./readme.js";
import { Studio } from "./studio.js";

const MAKERS: Record<string, Maker> = {
  "before-after": beforeAfter,
  errors: errorPlot,
  halo,
  radius,
};
const FOLDER = join("tests", "figures");

const ALL = Object.keys(MAKERS);
const names = process.argv.length > 2 ? process.argv.slice(2) : ALL;
const unknown = names.find((name) => !ALL.includes(name));
if (unknown !== undefined) {
  console.error(`There is no figure named ${unknown}. There are: ${ALL.join(", ")}.`);
  process.exit(2);
}
await init();
await draw(names);

async function draw(chosen: string[]): Promise<void> {
  await withStudio(async (studio) => {
    for (const name of chosen) {
      console.error(`Drawing ${name}…`);
      keep(await MAKERS[name]!(studio));
    }
  });
}

async function withStudio(use: (studio: Studio) => Promise<void>): Promise<void> {
  const studio = await Studio.open();
  try {
    await use(studio);
  } finally {
    await studio.close();
  }
}

function keep(figures: Figure[]): void {
  for (const { name, folder = FOLDER, png } of figures) write(join(folder, `${name}.png`), png);
  const readme = join(FOLDER, "README.md");
  write(readme, withFigures(readFileSync(join(root, readme), "utf8"), figures));
}

function write(file: string, content: string | Buffer): void {
  writeFileSync(join(root, file), content);
  console.log(file);
}
