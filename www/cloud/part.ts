import type { LoadedCloud, Values } from "./cloud.ts";

/** Some points of a cloud, with all that is known about them. `kept`: their indices. */
export function partOf(cloud: LoadedCloud, kept: Uint32Array): LoadedCloud {
  const { positions, colors, attributes = [], fields = attributes } = cloud;
  // Most fields are attributes, too. Then both have the same numbers afterwards, too.
  const done = new Map<Values, Values>();
  const ofKept = <T extends { values: Values }>(column: T): T => {
    const values =
      done.get(column.values) ?? (column.values.length === 1 ? column.values : picked(column.values, kept, 1));
    done.set(column.values, values);
    return { ...column, values };
  };
  return {
    ...cloud,
    origin: cloud.origin ? picked(cloud.origin, kept, 1) : kept,
    positions: picked(positions, kept, 3),
    colors: colors && picked(colors, kept, 3),
    attributes: attributes.map(ofKept),
    fields: fields.map(ofKept),
  };
}

function picked<T extends Values>(values: T, kept: Uint32Array, width: number): T {
  const result = new (values.constructor as new (length: number) => T)(width * kept.length);
  for (let i = 0; i < kept.length; i++) {
    for (let k = 0; k < width; k++) result[width * i + k] = values[width * kept[i]! + k]!;
  }
  return result;
}
