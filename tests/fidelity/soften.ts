/** Each value becomes the mean of itself and its neighbors along the edges, `rounds` times. `illuminate` does the same to its shadows. */
export function soften(values: Float32Array, triangles: Uint32Array, rounds: number): Float32Array {
  const neighbors = Array.from(values, (_, i) => new Set([i]));
  triangles.forEach((corner, i) => {
    const first = i - (i % 3);
    for (const other of triangles.subarray(first, first + 3)) neighbors[corner]!.add(other);
  });
  let now = Float64Array.from(values);
  for (let round = 0; round < rounds; round++) {
    now = Float64Array.from(neighbors, (around) => {
      let sum = 0;
      for (const one of around) sum += now[one]!;
      return sum / around.size;
    });
  }
  return Float32Array.from(now);
}
