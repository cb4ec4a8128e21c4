import { prepareCloud } from "../three/cloud.js";
import type { CloudNode } from "./node.js";
import type { NodesSettings } from "./options.js";

const SAMPLE = 30_000;

/**
 * The spacing of all nodes' points together, as the core measures it: nodes may lie in one
 * another, as levels of detail do. Of many points a sample, whose points are √(all ÷ sample)
 * times as far apart, as on any surface.
 */
export async function spacingOf(nodes: readonly CloudNode[], settings: NodesSettings): Promise<number> {
  const total = nodes.reduce((sum, { drawn }) => sum + drawn.total, 0);
  const numbers = sample(nodes, Math.max(1, total / SAMPLE));
  const count = numbers.length / 3;
  const cloud = await prepareCloud({ numbers, own: true }, { inWorker: settings.inWorker, nonFinite: "skip" });
  const { spacing } = cloud;
  void cloud.dispose();
  return total === 0 ? 0 : spacing * Math.sqrt(count / total);
}

/** One point of every so many, here and there among them: neighbors in a file are neighbors in space. */
function sample(nodes: readonly CloudNode[], every: number): Float64Array {
  const parts = nodes.map((node) => {
    const count = Math.floor(node.drawn.total / every);
    const indices = Uint32Array.from({ length: count }, (_, i) => Math.floor((i + spread(i)) * every));
    return node.positionsOf(every === 1 ? Uint32Array.from({ length: node.drawn.total }, (_, i) => i) : indices);
  });
  const numbers = new Float64Array(parts.reduce((sum, { length }) => sum + length, 0));
  let at = 0;
  for (const part of parts) {
    numbers.set(part, at);
    at += part.length;
  }
  return numbers;
}

/** From 0 to 1, the same for the same number: multiples of the golden ratio fill it evenly. */
function spread(i: number): number {
  return (i * 0.618033988749895) % 1;
}
