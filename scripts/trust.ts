// npm run trust: writes tests/TRUST.md, the results of every long check and the faults that were found, from the
// files that those checks have written.
import { writeFileSync } from "node:fs";

import { inRoot, root } from "./lib/paths.js";
import { TRUST, trust } from "./trust/text.js";

writeFileSync(inRoot(TRUST), trust(root));
console.log(TRUST);
