// Figure 7 of the paper: errors against R.
import { join } from "node:path";

import type * as PlotLibrary from "@observablehq/plot";

import { type Curve, curves, meanCurve } from "../fidelity/curves.js";
import { scanned } from "../fidelity/truth.js";
import { root } from "../root.js";
import { count, digits, type Maker, small } from "./figure.js";

declare const Plot: typeof PlotLibrary;

const LIBRARIES = ["d3/dist/d3.min.js", "@observablehq/plot/dist/plot.umd.min.js"];
const STYLE = `
  body { margin: 0; padding: 12px 12px 18px; width: 936px; background: white; color: #1b1f24; font: 15px system-ui, sans-serif;
         display: grid; grid-template-columns: 468px 468px; row-gap: 18px; }
  body > :first-child { grid-column: span 2; margin-left: 46px; }
  h2 { font-size: 15px; margin: 0 0 0 46px; }
`;

interface Panel {
  title: string;
  curve: Curve;
  /** The numbers behind the picture. */
  words: string;
}

export const errorPlot: Maker = async (studio) => {
  const panels = [...scanned()].flatMap((labelled): Panel[] => {
    const all = curves(labelled);
    const mean = meanCurve(all);
    const name = `${labelled.name}, ${count(labelled.positions.length / 3)} points`;
    return [
      {
        title: `${name}: one view`,
        curve: all[0]!,
        words: `from (${labelled.views[0]!.viewpoint.map(digits).join(", ")}): ${chosen(all[0]!)}`,
      },
      {
        title: `${name}: mean of ${all.length} views`,
        curve: mean,
        words: `on average: ${chosen(mean)}, the best exponent for all views ${least(mean)}`,
      },
    ];
  });
  if (panels.length === 0) return [];
  const png = await studio.print(`<style>${STYLE}</style>`, 960, async (page) => {
    for (const library of LIBRARIES) await page.addScriptTag({ path: join(root, "node_modules", library) });
    await page.evaluate(draw, panels);
  });
  const totals = panels.map(({ title, words }) => `- ${title.split(",")[0]!} ${words}`);
  return [
    {
      name: "error-against-radius",
      title: "Errors against R (paper: Fig. 7)",
      caption:
        "False positives, false negatives and their sum in % of all points, against ray-traced visibility. Small spheres hide visible points, " +
        "large ones let hidden points through, and the sum has a narrow valley between. A dot is a rule's choice and its error. " +
        "In the means it may lie below the curve, because a rule chooses anew for each view. The paper's rule ends far to the right of " +
        `the valley. Exponents, and totals:\n\n${totals.join("\n")}`,
      png: await small(png),
    },
  ];
};

function chosen({ rules }: Curve): string {
  return rules.map(({ rule, exponent, total }) => `${rule} ${exponent.toFixed(2)} (${total.toFixed(1)} %)`).join(", ");
}

function least({ errors }: Curve): string {
  const { exponent, total } = errors.reduce((best, at) => (at.total < best.total ? at : best));
  return `${exponent.toFixed(2)} (${total.toFixed(1)} %)`;
}

/** Runs in the page. */
function draw(panels: Panel[]): void {
  const kinds = [
    ["FP + FN", "total", "#1b1f24"],
    ["false positives", "falsePositives", "#c2410c"],
    ["false negatives", "falseNegatives", "#2563a8"],
  ] as const;
  const colors: Record<string, string> = {
    automatic: "#15803d",
    "antipodal search": "#7e3fb3",
    "the paper's rule": "#a16207",
  };
  const color = { domain: kinds.map(([kind]) => kind), range: kinds.map(([, , shade]) => shade) };
  document.body.append(Plot.legend({ color, style: { fontSize: "14px" } }));
  for (const { title, curve } of panels) {
    const lines = kinds.flatMap(([kind, key]) =>
      curve.errors.map((at) => ({ kind, exponent: at.exponent, percent: at[key] })),
    );
    // Labels of close lines must be readable: the first is left of its line, the others are right of it and lower.
    const rules = curve.rules.toSorted((a, b) => a.exponent - b.exponent);
    const plot = Plot.plot({
      width: 460,
      height: 276,
      marginLeft: 46,
      marginTop: 8,
      marginBottom: 48,
      style: { fontSize: "13px", background: "white" },
      x: {
        domain: [1, 5.5],
        label: "log₁₀ (R ÷ farthest distance)",
        labelAnchor: "center",
        labelOffset: 38,
        labelArrow: "none",
        ticks: 9,
      },
      y: { domain: [0, 30], label: "% of all points", labelAnchor: "center", labelArrow: "none", grid: true, ticks: 6 },
      color,
      marks: [
        Plot.ruleX(curve.rules, {
          x: "exponent",
          stroke: ({ rule }: { rule: string }) => colors[rule],
          strokeDasharray: "4 3",
        }),
        Plot.line(lines, { x: "exponent", y: "percent", stroke: "kind", strokeWidth: 2, clip: true }),
        Plot.dot(curve.rules, {
          x: "exponent",
          y: "total",
          fill: ({ rule }: { rule: string }) => colors[rule],
          r: 4.5,
          stroke: "white",
        }),
        ...rules.map((chosen, i) =>
          Plot.text([chosen], {
            x: "exponent",
            y: i === 1 ? 26.5 : 28.8,
            text: () => chosen.rule.replace("the ", ""),
            fill: colors[chosen.rule]!,
            stroke: "white",
            strokeWidth: 4,
            fontWeight: 600,
            textAnchor: i === 0 ? "end" : "start",
            dx: i === 0 ? -5 : 5,
          }),
        ),
      ],
    });
    const heading = document.createElement("h2");
    heading.textContent = title;
    const cell = document.createElement("div");
    cell.append(heading, plot);
    document.body.append(cell);
  }
}
