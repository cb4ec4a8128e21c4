// tests/figures/README.md: one section for each figure.
import type { Figure } from "./figure.js";

const ORDER = [
  "bunny",
  "dragon",
  "room",
  "rings",
  "error-against-radius",
  "radius",
  "surface-dragon",
  "surface-bunny",
  "shadows",
  "shadows-soft",
  "shadows-two",
];

const INTRODUCTION = `# The paper's figures

\`npm run figures\` draws them all again, with the demo page in Chromium, and measures the captions' numbers on the way;
names after \`--\` choose some (before-after, errors, radius, reconstruction, shadows, fidelity). Viewpoints and lights are in
the coordinates of the files. Part of it needs data that is not in the repository (\`HPR_SHARED\`); without it the errors
against R and the bunny's surface are left as they are, and the first bunny is the small one of npm.
[FIDELITY.md](FIDELITY.md) has the errors in numbers.

The paper's own clouds cannot be had here, save for the dragon and the bunny: not David, Bimba, Igea, the hand, the carter, the
oil pump, the block, the bottle nor the jet fighter (the airplane of rings stands in for it). Nor can its times be measured again:
Matlab on a computer of 2007. Figures 3 and 5 illustrate the flip in two dimensions and show no result.

The Stanford dragon and bunny: Stanford Computer Graphics Laboratory, The Stanford 3D Scanning Repository.
`;

/** The text with new sections for these figures. The other sections stay. */
export function withFigures(existing: string, made: Figure[]): string {
  const sections = new Map<string, string>();
  for (const part of existing.split(/^## /m).slice(1)) {
    const name = /\]\(([\w-]+)\.png\)/.exec(part)?.[1];
    if (name !== undefined) sections.set(name, `## ${part.trimEnd()}\n`);
  }
  for (const { name, title, caption } of made)
    sections.set(name, `## ${title}\n\n![${title}](${name}.png)\n\n${caption}\n`);
  return [INTRODUCTION, ...ORDER.flatMap((name) => sections.get(name) ?? [])].join("\n");
}
