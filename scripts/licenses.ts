// npm run licenses: writes THIRD_PARTY.md.
import { writeFileSync } from "node:fs";

import { command } from "./lib/command.js";
import { setUpRust } from "./setup/rust.js";
import { THIRD_PARTY, shipped, thirdPartyText } from "./supply/third-party.js";

await command(async () => {
  await setUpRust();
  writeFileSync(THIRD_PARTY, thirdPartyText(await shipped()));
  console.log("THIRD_PARTY.md");
});
