import { rowOf, type Settings, USUAL_SETTINGS, type Viewpoint } from "./settings.ts";
import type { Store } from "./store.ts";
import { PARAMETERS, type SettingName, SETTINGS } from "./table.ts";

/** How the address names a cloud, by parameter and value: a sample of the page, or a file on the web. */
export type CloudName = ["sample" | "src", string];

/** The settings that a cloud is seen with if the address says nothing. */
export type Usual = Pick<Settings, "size" | "fieldOfView" | "up">;

export interface CameraPlace {
  view: Viewpoint;
  /** `null`: the middle of the cloud. */
  target: Viewpoint | null;
}

/** The address of a cloud, and the settings that it need not say. */
interface Named {
  name: CloudName;
  usual: Usual;
}

/** Milliseconds without a change before the address is written: browsers refuse to write it every frame. */
const CALM = 300;

/** Keeps the page's address such that a copy of it shows the same cloud, picture and settings again. */
export class Address {
  /** `null` for the usual place. */
  readonly #camera: () => CameraPlace | null;
  readonly #store: Store;
  /** `null`: a file from this device, which no address can open. */
  #cloud: Named | null = null;
  /** The address before a cloud was chosen. It comes back if that cloud cannot be opened. */
  #before: { cloud: Named | null; href: string } | null = null;
  /** Whether the picture is divided only as an introduction to the page. */
  readonly #introducing: () => boolean;
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor(store: Store, camera: () => CameraPlace | null, introducing: () => boolean) {
    this.#store = store;
    this.#camera = camera;
    this.#introducing = introducing;
    store.follow(() => {
      this.touch();
    });
  }

  /** This cloud is on screen now, and the address follows it. */
  begin(name: CloudName | null, usual: Usual): void {
    this.#cloud = name && { name, usual };
    this.#before = null;
    this.touch();
  }

  /** Names a cloud at once that is about to be loaded. Parameters of the cloud before it go. */
  choose([parameter, value]: CloudName): void {
    this.#before ??= { cloud: this.#cloud, href: location.href };
    this.#cloud = null;
    const address = new URL(location.href);
    const ofCloud = Object.values(SETTINGS).filter((row) => row.ofCloud);
    for (const name of ["src", "view", "target", ...ofCloud.map((row) => row.parameter)])
      address.searchParams.delete(name);
    address.searchParams.set(parameter, value);
    replace(address);
  }

  /** The chosen cloud could not be opened: the one before has stayed, and its address comes back. */
  giveUp(): void {
    if (!this.#before) return;
    this.#cloud = this.#before.cloud;
    replace(new URL(this.#before.href));
    this.#before = null;
    this.touch();
  }

  /** Something has changed that the address may have to say. */
  touch(): void {
    if (!this.#cloud) return;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => {
      this.#write();
    }, CALM);
  }

  /** The page as it is now, for others to open; `null` if no address can open it. */
  link(): string | null {
    this.#write();
    return this.#cloud && location.href;
  }

  #write(): void {
    if (!this.#cloud) return;
    const { name, usual } = this.#cloud;
    const address = new URL(location.href);
    const { searchParams } = address;
    const introducing = this.#introducing();
    const settings = introducing ? { ...this.#store.current, compare: null } : this.#store.current;
    const values = { ...settingsInAddress(settings, usual), ...cameraInAddress(this.#camera()) };
    // Nothing has been done yet: the bare address stays, and brings the introduction the next time.
    if (introducing && address.search === "" && Object.values(values).every((texts) => texts.length === 0)) return;
    searchParams.delete(name[0] === "src" ? "sample" : "src");
    searchParams.set(...name);
    for (const [parameter, texts] of Object.entries(values)) {
      searchParams.delete(parameter);
      for (const text of texts) searchParams.append(parameter, text);
    }
    replace(address);
  }
}

/** Every parameter with its values; with none where the setting is the usual one. */
function settingsInAddress(now: Settings, usual: Usual): Record<string, string[]> {
  // A radius has one of two parameters.
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
  texts[SETTINGS.lights.parameter] = now.lights.map(String);
  if ("exponent" in radius) texts[SETTINGS.radius.parameter] = [];
  // Without a comparison its kind means nothing, and without the z-buffer the width of its points.
  if (now.compare === null) texts[SETTINGS.against.parameter] = [];
  if (now.compare === null || now.against !== "zbuffer") texts[SETTINGS.splat.parameter] = [];
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
