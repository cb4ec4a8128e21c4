/** The classes of the LAS specification (1.4 R15, table 17). */
export const CLASSES: Readonly<Record<number, string>> = {
  0: "never classified", 1: "unclassified", 2: "ground", 3: "low vegetation", 4: "medium vegetation", 5: "high vegetation",
  6: "building", 7: "low noise", 8: "key point", 9: "water", 10: "rail", 11: "road", 12: "overlap", 13: "wire guard",
  14: "wire", 15: "transmission tower", 16: "wire connector", 17: "bridge deck", 18: "high noise", 19: "overhead structure",
  20: "ignored ground", 21: "snow", 22: "temporal exclusion",
}; // prettier-ignore

/** The name of the column with a point's class. */
export const CLASSIFICATION = "classification";
