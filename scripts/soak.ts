// npm run soak [-- --views N --points N]: what takes too long for npm test. The page's memory and its maps
// (tests/browser: soak, orbit), many views in workers, all maps of a turn, and one large cloud (tests/soak). Ends with
// status 1 if an answer was wrong or memory grew.
import { parseArgs } from "node:util";

import { build } from "./build/build.js";
import { run } from "./lib/run.js";
import { load } from "./lib/load.js";
import { setUpBrowser } from "./setup/system.js";

interface Soak {
  views: (count: number) => Promise<boolean>;
  maps: () => Promise<boolean>;
  large: (points: number) => Promise<boolean>;
}

export async function soak(args: string[]): Promise<void> {
  const text = { type: "string" } as const;
  const { values } = parseArgs({ args: args, options: { views: text, points: text } });
  await build();
  const env = { HPR_CHROMIUM: await setUpBrowser(), HPR_SOAK: "1" };
  const page = await run("vitest", ["run", "tests/browser/soak.test.ts", "tests/browser/orbit.test.ts"], {
    show: "results",
    env,
  });
  const { large, maps, views } = await load<Soak>("tests/soak/soak.ts");
  const right = [
    page.ok,
    await views(Number(values.views ?? 20_000)),
    await maps(),
    await large(Number(values.points ?? 10_000_000)),
  ];
  // Open workers must not keep the process alive.
  process.exit(right.every(Boolean) ? 0 : 1);
}
