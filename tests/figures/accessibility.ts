// Writes docs/ACCESSIBILITY.md: axe-core's results for every state of the page that its tests visit.
import axe, { type AxeResults } from "axe-core";

import { audit, JUDGED, TAGS, VISITS } from "../browser/accessibility.js";
import type { Studio } from "./studio.js";

interface Finding {
  state: string;
  result: AxeResults;
  poor: string[];
}

/** Makes each visit on a page of its own, and audits each step. */
export async function accessibilityText(studio: Studio): Promise<string> {
  const found: Finding[] = [];
  for (const { name, query, options, steps } of VISITS) {
    console.error(`Visiting ${name}…`);
    await studio.visit(query, options, async (page) => {
      for (const step of steps) {
        await step.act(page);
        for (const { theme, result, poor } of await audit(page))
          found.push({ state: `${name}, ${theme}: ${step.name}`, result, poor });
      }
    });
  }
  return text(found);
}

function text(found: Finding[]): string {
  const rules = new Map<string, { help: string; tags: string[]; passed: number; violated: string[]; open: string[] }>();
  const rule = ({ id, help, tags }: AxeResults["passes"][number]) => {
    const known = rules.get(id) ?? { help, tags, passed: 0, violated: [], open: [] };
    rules.set(id, known);
    return known;
  };
  for (const { state, result } of found) {
    for (const passed of result.passes) rule(passed).passed++;
    for (const violation of result.violations) rule(violation).violated.push(state);
    for (const open of result.incomplete) rule(open).open.push(state);
  }
  const all = [...rules].sort(([a], [b]) => a.localeCompare(b));
  const violations = all.filter(([, { violated }]) => violated.length > 0);
  const open = all.filter(([, { open: states }]) => states.length > 0);
  const poor = found.flatMap(({ state, poor: texts }) => texts.map((one) => `${state}: ${one}`));
  return [
    "# Accessibility of the demo page",
    "",
    `axe-core ${axe.version}, rules ${TAGS.join(", ")}, in ${found.length / 2} states of the page: wide, on a phone and in another page.`,
    "Each state is checked in the dark theme. The light theme differs only in colors, so there only the rules about colors are checked again.",
    "Written by `npm run figures -- accessibility`; `tests/browser/accessibility.test.ts` requires the same result in every `npm test`.",
    "",
    `**Violations: ${violations.length}.** ${list(violations.map(([id, { violated }]) => `\`${id}\` (${violated.join("; ")})`))}`,
    "",
    `**Texts below 4.5 to 1 (large ones 3 to 1): ${poor.length}.** ${list(poor)}`,
    "",
    "## Left open by axe-core, judged by hand",
    "",
    ...(open.length === 0
      ? ["Nothing."]
      : open.map(
          ([id, { open: states }]) => `- \`${id}\` in ${states.length} states. ${JUDGED[id] ?? "Not judged yet."}`,
        )),
    "",
    "## What other tests check",
    "",
    "- `keyboard.test.ts`: Tab reaches everything, wide in the dark theme and on a phone in the light one, each focus has a visible ring with a contrast of at least 3 to 1, and the focus can leave the page; full screen; reduced motion.",
    "- `layout.test.ts`: nothing overlaps, also with text of twice the size, on a phone held sideways and with the system's own colors.",
    "- `loading.test.ts`: nothing moves about while the page loads.",
    "- `controls.test.ts`: a new sentence is announced once, after the movement that changes it.",
    "",
    "## States",
    "",
    ...found.map(
      ({ state, result }) =>
        `- ${state}: ${result.passes.length} rules passed, ${result.violations.length} violated, ${result.incomplete.length} open`,
    ),
    "",
    "## Rules that passed",
    "",
    "| rule | requirement | states |",
    "|---|---|---|",
    ...all
      .filter(([, { passed }]) => passed > 0)
      .map(([id, { help, passed }]) => `| \`${id}\` | ${help.replaceAll("<", "&lt;")} | ${passed} |`),
    "",
  ].join("\n");
}

function list(items: string[]): string {
  return items.length === 0 ? "" : items.join(", ");
}
