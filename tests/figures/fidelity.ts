// Writes tests/figures/FIDELITY.md: the fidelity tables, and how they were made.
import { markdown } from "../bench/report.js";
import { traceAgain } from "../fidelity/agreement.js";
import { fidelityTables } from "../fidelity/tables.js";

const INTRODUCTION = `# Fidelity

How often the library is wrong about what a viewpoint sees, by every way of asking it. Asked through the JavaScript package
(WebAssembly, in Node); the truth is that of rays from each point to the viewpoint against the surface's mesh.

- command: \`npm run figures -- fidelity\`; \`npm run bench -- --fidelity\` prints the same tables
- scanned surfaces: the vertices of meshes, with labels from \`HPR_SHARED\`; the best R of each view is the one its
  \`reference.json\` holds, and only views that are in it count
- generated surfaces: random points on the faces of meshes made here, ray-traced here; the best R of each view is found by scanning
  exponents 0.05 apart; 4 viewpoints from 2.5 and 4 from 1.3 radii of the box's corner sphere, 8 between the furniture of the room
- unevenly sampled surfaces: the corners of long, thin triangles, patches of other density, decimated scans; made and ray-traced here,
  in two halves of other shapes, proportions and seeds. The automatic R was chosen on the first half and on other clouds; the
  second half was seen meanwhile. The shapes that were made later come from \`tests/fidelity/later.ts\`: nobody had seen them when the
  last rule was chosen
- the room has surfaces millimeters apart, a rug on the floor and books on a shelf, which points centimeters apart cannot tell
  from one another; hence its false positives, even with the best R
- 5 viewpoints: the viewpoint and a ring of 4 around it at 5 % of its distance from the middle of the box
- power as curved as automatic: 1/d^γ with γ such that a surface facing the viewer may be as curved as with the automatic R
`;

/** Undefined if the labels are missing, because most tables need them. */
export async function fidelityText(say: (message: string) => void): Promise<string | undefined> {
  const agreement = traceAgain(say);
  if (agreement === undefined) return undefined;
  const checked =
    `- the ray tracer that made the generated surfaces' labels gives ${agreement.same.toLocaleString("en-US")} of ` +
    `${agreement.labels.toLocaleString("en-US")} labels of ${agreement.name} as they are in \`HPR_SHARED\`\n`;
  return [INTRODUCTION + checked, ...(await fidelityTables(say)).map(markdown)].join("\n");
}
