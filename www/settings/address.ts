import { canLook, rowOf, type Settings, type Store, USUAL_SETTINGS, type Viewpoint, withLooks } from "./settings.ts";
import {
  type Parameter,
  PARAMETERS,
  refusalOf,
  type SettingName,
  SETTINGS,
  STATION_COLORS,
  STORIES,
  type StoryName,
} from "./table.ts";

/** How the address names a cloud, by parameter and value: a sample of the page, or a file on the web. */
export type CloudName = ["sample" | "src", string];

/** The settings of a cloud that hold if the address does not have them. */
export type Usual = Pick<Settings, "size" | "fieldOfView" | "up">;

export interface CameraPlace {
  view: Viewpoint;
  /** `null`: the middle of the cloud. */
  target: Viewpoint | null;
}

/** The name of a cloud in the address, and the settings that the address need not have. */
interface Named {
  name: CloudName;
  usual: Usual;
}

/** The parameters for marks and stations. tools/link.ts writes and reads them. */
export const MARK_PARAMETERS = ["measure", "label", "station"] as const;
export type MarkParameter = (typeof MARK_PARAMETERS)[number];

/** The parts of the page that are in the address beside the settings. */
export interface Beside {
  /** `null` for the usual place. */
  camera: () => CameraPlace | null;
  /** `null`: the tools are not there yet, so the address keeps its marks. */
  marks: () => Record<MarkParameter, string[]> | null;
  /** Whether the page shows something by itself: its first sight, or a story. */
  isOwn: () => boolean;
}

/** The address is written after this many milliseconds without a change. Browsers refuse to write it every frame. */
const CALM = 300;

/** Keeps the page's address up to date: a copy of it opens the same cloud, picture and settings. */
export class Address {
  readonly #beside: Beside;
  readonly #store: Store;
  /** `null`: a file from this device, which no address can open. */
  #cloud: Named | null = null;
  /** The address before a cloud was chosen. It comes back if that cloud cannot be opened. */
  #before: { cloud: Named | null; href: string } | null = null;
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor(store: Store, beside: Beside) {
    this.#store = store;
    this.#beside = beside;
    store.follow(() => this.touch());
  }

  /** Must be called when a cloud is on screen. From then on, the address follows it. */
  begin(name: CloudName | null, usual: Usual): void {
    this.#cloud = name && { name, usual };
    this.#before = null;
    // No address can open a file of this device.
    if (!name) replace(new URL(location.pathname, location.href));
    this.touch();
  }

  /** Writes the name of a cloud before it is loaded. Removes the parameters of the cloud before it. */
  choose([parameter, value]: CloudName): void {
    this.#before ??= { cloud: this.#cloud, href: location.href };
    this.#cloud = null;
    const address = new URL(location.href);
    const ofCloud = Object.values(SETTINGS).filter((row) => row.ofCloud);
    for (const name of ["src", "view", "target", ...MARK_PARAMETERS, ...ofCloud.map((row) => row.parameter)]) {
      address.searchParams.delete(name);
    }
    address.searchParams.set(parameter, value);
    replace(address);
  }

  /** Writes the name of a story, and nothing else. It stays while the story is told. `leaves`: the browser can go back. */
  tell(story: string, leaves: boolean): void {
    const { href } = new URL(`?${new URLSearchParams({ story }).toString()}`, location.href);
    if (href === location.href) return;
    if (leaves) history.pushState(null, "", href);
    else history.replaceState(null, "", href);
  }

  /** Brings the address of the cloud before back, because the chosen cloud could not be opened. */
  giveUp(): void {
    if (!this.#before) return;
    this.#cloud = this.#before.cloud;
    replace(new URL(this.#before.href));
    this.#before = null;
    this.touch();
  }

  /** Must be called when something has changed that may be part of the address. */
  touch(): void {
    if (!this.#cloud) return;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#write(), CALM);
  }

  /** The address that opens the page as it is now. `null` if no address can do that. */
  link(): string | null {
    this.#write();
    return this.#cloud && location.href;
  }

  #write(): void {
    if (!this.#cloud) return;
    const { name, usual } = this.#cloud;
    const address = new URL(location.href);
    const { searchParams } = address;
    // The next visit begins with the same.
    if (this.#beside.isOwn()) return;
    const values = {
      ...settingsInAddress(this.#store.current, usual),
      ...cameraInAddress(this.#beside.camera()),
      ...this.#beside.marks(),
    };
    for (const other of ["sample", "src", "story"]) if (other !== name[0]) searchParams.delete(other);
    searchParams.set(...name);
    for (const [parameter, texts] of Object.entries(values)) {
      searchParams.delete(parameter);
      for (const text of texts) searchParams.append(parameter, text);
    }
    replace(address);
  }
}

/** Every parameter with its values. If the setting is the usual one, there are no values. */
function settingsInAddress(now: Settings, usual: Usual): Record<string, string[]> {
  // A radius is written by one of two parameters.
  const { radius } = now;
  const texts: Record<string, string[]> = {
    exponent: "exponent" in radius ? [PARAMETERS.exponent.write(radius.exponent)] : [],
  };
  const write = (name: SettingName) => {
    const row = rowOf(name);
    const usually = { ...USUAL_SETTINGS, ...usual }[name];
    const text = row.write(now[name]);
    texts[row.parameter] = text === row.write(usually) ? [] : [text];
  };
  for (const name of Object.keys(SETTINGS)) write(name as SettingName);
  if ("exponent" in radius) texts[SETTINGS.radius.parameter] = [];
  if (now.color === STATION_COLORS) texts[SETTINGS.color.parameter] = [];
  if (!canLook(now)) texts[SETTINGS.looks.parameter] = [];
  return texts;
}

function cameraInAddress(camera: CameraPlace | null): Record<string, string[]> {
  return {
    view: camera ? [PARAMETERS.view.write(camera.view)] : [],
    target: camera?.target ? [PARAMETERS.target.write(camera.target)] : [],
  };
}

function replace(address: URL): void {
  const { href } = readable(address);
  if (href !== location.href) history.replaceState(null, "", href);
}

/** Commas and colons may stand in an address as they are, and are easier to read. */
export function readable(address: URL): URL {
  address.search = address.search.replaceAll("%2C", ",").replaceAll("%3A", ":");
  return address;
}

/** What the address of the page asks for. The notes name, in plain words, everything that cannot be used. */
export interface AddressParameters {
  sample: string;
  src: string | null;
  /** Where the camera stands, in the file's own coordinates, and what it looks at. */
  view: Viewpoint | null;
  target: Viewpoint | null;
  /** The most points of a file that are shown. `null`: as many as the page can show. */
  points: number | null;
  /** Whether the picture turns by itself. */
  turns: boolean;
  /** The story that is told. It chooses the sample. */
  story: StoryName | null;
  /** Whether the address asks for nothing, but maybe for whether the picture turns. */
  isFirst: boolean;
  /** The settings that are in the address. */
  settings: Partial<Settings>;
  notes: string[];
}

/** Reads the address. The first sample is the usual one. */
export function readAddress(search: string, samples: readonly string[]): AddressParameters {
  const query = new URLSearchParams(search);
  const notes: string[] = [];

  let sample = query.get("sample") ?? samples[0]!;
  if (!samples.includes(sample)) {
    notes.push(`There is no sample called “${sample}”, so this is the ${samples[0]}.`);
    sample = samples[0]!;
  }
  const src = query.get("src");
  if (src === "") notes.push(`The address names no file after “src=”, so this is the ${sample}.`);

  /** Returns `undefined` if the address does not have the parameter, or if its value cannot be used. */
  const read = <T>(name: string, row: Parameter<T>, otherwise: { otherwise?: string } = {}): T | undefined => {
    const text = query.get(name);
    const value = text === null ? undefined : row.parse(text);
    if (text !== null && value === undefined) {
      notes.push(`The ${row.called ?? name} in the address is not ${refusalOf({ ...row, ...otherwise })}.`);
    }
    return value;
  };

  // The radius is the other way to say the same.
  const isRadiusGiven = SETTINGS.radius.parse(query.get("radius") ?? "") !== undefined;
  const exponent = read("exponent", PARAMETERS.exponent, isRadiusGiven ? { otherwise: "the radius is used" } : {});
  const found: Partial<Record<SettingName, unknown>> = {};
  for (const name of Object.keys(SETTINGS) as SettingName[]) {
    const row = rowOf(name);
    const value = read(row.parameter, row);
    if (value !== undefined) found[name] = value;
  }
  let settings = found as Partial<Settings>;
  if (settings.radius && exponent !== undefined) {
    notes.push("Radius and exponent in the address exclude each other, so the exponent is used.");
  }
  if (exponent !== undefined) settings.radius = { exponent };
  settings = withLooks(settings);
  if (settings.looks && !canLook({ ...USUAL_SETTINGS, ...settings })) {
    notes.push(
      "Looks in the address exclude exponent, radius and inversion, so there is one hull, as these parameters say.",
    );
  }
  const turn = read("turn", PARAMETERS.turn);
  const story = read("story", PARAMETERS.story) ?? null;
  const isFirst = [...query.keys()].every((name) => name === "turn");

  return {
    sample: story ? STORIES[story] : sample,
    src: src === "" || story ? null : src,
    story,
    view: read("view", PARAMETERS.view) ?? null,
    target: read("target", PARAMETERS.target) ?? null,
    points: read("points", PARAMETERS.points) ?? null,
    turns: turn === undefined ? isFirst : turn === "1",
    isFirst,
    settings,
    notes,
  };
}
