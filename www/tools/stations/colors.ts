/** The color of points that no station sees: it stands out from all counts, also for the color-blind. */
const NONE = "#f0433a";
/** From few stations to many: each one is lighter than the one before, so that the order is seen without the legend. */
const FEW = [38, 79, 120];
const MANY = [240, 228, 150];

/** A color for each count of stations, from none to the most. */
export function countColors(most: number): Record<number, string> {
  const colors: Record<number, string> = { 0: NONE };
  for (let count = 1; count <= most; count++) {
    const share = most > 1 ? (count - 1) / (most - 1) : 0.5;
    const parts = FEW.map((from, channel) => Math.round(from + share * (MANY[channel]! - from)));
    colors[count] = `#${parts.map((part) => part.toString(16).padStart(2, "0")).join("")}`;
  }
  return colors;
}
