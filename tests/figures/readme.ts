// tests/figures/README.md: one section for each figure.
import type { Figure } from "./figure.js";

const ORDER = ["bunny", "dragon", "room", "error-against-radius", "radius"];

const INTRODUCTION = `# The paper's figures

\`npm run figures\` draws all figures again, with the demo page in Chromium, and measures the numbers of the captions.
Names after \`--\` choose some (before-after, errors, halo, radius). Viewpoints are in
the coordinates of the files. Some figures need data that is not in the repository (\`HPR_SHARED\`). Without this data, the
errors against R are not drawn again, and the first figure shows the small bunny from npm.
[FIDELITY.md](FIDELITY.md) has the errors in numbers.

Of the paper's own clouds, only the dragon and the bunny are available here. David, Bimba, Igea, the hand, the carter, the oil
pump, the block, the bottle and the jet fighter are not. The paper's
times cannot be measured again, because they come from Matlab on a computer of 2007. Figures 3 and 5 illustrate the flip in
two dimensions and show no result.

The Stanford dragon and bunny: Stanford Computer Graphics Laboratory, The Stanford 3D Scanning Repository.
`;

/** The text with new sections for these figures. The other sections stay. */
export function withFigures(existing: string, made: Figure[]): string {
  const sections = new Map<string, string>();
  for (const part of existing.split(/^## /m).slice(1)) {
    const name = /\]\(([\w-]+)\.png\)/.exec(part)?.[1];
    if (name !== undefined) sections.set(name, `## ${part.trimEnd()}\n`);
  }
  for (const { name, title, caption } of made) {
    sections.set(name, `## ${title}\n\n![${title}](${name}.png)\n\n${caption}\n`);
  }
  return [INTRODUCTION, ...ORDER.flatMap((name) => sections.get(name) ?? [])].join("\n");
}
