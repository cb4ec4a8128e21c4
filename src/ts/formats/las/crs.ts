/** A unit of length. */
export interface Unit {
  /** Its short name, as it is written after a number. */
  name: string;
  meters: number;
}

/** The coordinate reference system that a file names. */
export interface Crs {
  name: string;
  /** The unit of x and y. `null`: it is not known, or it is an angle. */
  unit: Unit | null;
  /** The unit of z, if the file gives one of its own. */
  heightUnit: Unit | null;
  /** Whether x and y are degrees of longitude and latitude. */
  isAngular: boolean;
}

/** The parts of a LAS file that may name its coordinate system: OGC WKT, or the keys of GeoTIFF. */
export interface CrsRecords {
  wkt?: string;
  /** Four numbers for each key: key, place of the value, count, value or offset. */
  keys?: Uint16Array;
  texts?: string;
}

const METER: Unit = { name: "m", meters: 1 };
const FOOT: Unit = { name: "ft", meters: 0.3048 };
const SURVEY_FOOT: Unit = { name: "ft (US survey)", meters: 1200 / 3937 };

/** The codes of units in the EPSG registry. */
const UNITS: Readonly<Record<number, Unit>> = { 9001: METER, 9002: FOOT, 9003: SURVEY_FOOT };
/** GeoTIFF's keys, as in its specification (OGC 19-008r4). */
const KEY = {
  model: 1024, citation: 1026, geographic: 2048, projected: 3072, projectedCitation: 3073, unit: 3076, heightUnit: 4099,
}; // prettier-ignore
const GEOGRAPHIC = 2;
/** A code that stands for a system that the file defines itself. */
const USER_DEFINED = 32_767;

/** The coordinate system that the records name. `null`: they name none. */
export function crsOf({ wkt, keys, texts }: CrsRecords): Crs | null {
  if (wkt) return fromWkt(wkt);
  return keys ? fromKeys(keys, texts ?? "") : null;
}

/** Reads a name and the units, in both versions of WKT. All other parts do not matter here. */
function fromWkt(wkt: string): Crs | null {
  const name = /^\s*\w+\s*\[\s*"([^"]*)"/.exec(wkt)?.[1]?.trim();
  if (!name) return null;
  const vertical = /\bVERT_?CR?S\s*\[/.exec(wkt);
  const horizontal = vertical ? wkt.slice(0, vertical.index) : wkt;
  const isAngular = !/\bPROJ(CS|CRS)\s*\[/.test(horizontal);
  return {
    name,
    unit: isAngular ? null : lastUnit(horizontal),
    heightUnit: vertical ? lastUnit(wkt.slice(vertical.index)) : null,
    isAngular: isAngular && /\bGEOG(CS|CRS)\s*\[/.test(horizontal),
  };
}

/** The unit of a system follows its parts, so the last length is that of the whole. */
function lastUnit(wkt: string): Unit | null {
  const units = [...wkt.matchAll(/\b(?:LENGTH)?UNIT\s*\[\s*"([^"]*)"\s*,\s*([-+.\deE]+)/g)];
  const [, name, meters] = units.findLast(([, unit]) => !/degree|radian|grad/i.test(unit!)) ?? [];
  return name === undefined ? null : unitOf(name, Number(meters));
}

function unitOf(name: string, meters: number): Unit | null {
  if (!(meters > 0)) return null;
  const known = Object.values(UNITS).find((unit) => Math.abs(unit.meters / meters - 1) < 1e-9);
  return known ?? { name, meters };
}

function fromKeys(keys: Uint16Array, texts: string): Crs | null {
  const found = new Map<number, number>();
  const cited = new Map<number, string>();
  for (let at = 4; at + 4 <= keys.length; at += 4) {
    const [key, place, count, value] = keys.subarray(at, at + 4) as unknown as [number, number, number, number];
    if (place === 0) found.set(key, value);
    else if (place === 34737) cited.set(key, texts.slice(value, value + count).replace(/[|\0\s]+$/, ""));
  }
  const isAngular = found.get(KEY.model) === GEOGRAPHIC;
  const code = found.get(isAngular ? KEY.geographic : KEY.projected) ?? USER_DEFINED;
  const epsg = code > 0 && code < USER_DEFINED ? `EPSG:${code}` : null;
  const name = [cited.get(KEY.projectedCitation) ?? cited.get(KEY.citation), epsg].filter(Boolean).join(", ");
  if (name === "") return null;
  const unit = UNITS[found.get(KEY.unit) ?? 0] ?? (isUtm(code) ? METER : null);
  return { name, unit: isAngular ? null : unit, heightUnit: UNITS[found.get(KEY.heightUnit) ?? 0] ?? null, isAngular };
}

/** The zones of UTM for WGS 84 and ETRS89. They count in meters, and many files do not say so again. */
function isUtm(code: number): boolean {
  return (code > 32_600 && code <= 32_660) || (code > 32_700 && code <= 32_760) || (code >= 25_828 && code <= 25_838);
}
