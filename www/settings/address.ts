import { type Inversion, type Radius, type Settings, type Store, USUAL_SETTINGS, type Viewpoint } from "./settings.ts";

/** What the address says of a cloud: a sample of the page or a file on the web, by its parameter and value. */
export type CloudName = ["sample" | "src", string];

/** What the cloud would be seen with if the address said nothing. */
export type Usual = Pick<Settings, "size" | "fieldOfView" | "up">;

export interface CameraPlace {
  view: Viewpoint;
  /** `null`: the middle of the cloud. */
  target: Viewpoint | null;
}

/** The address is written when nothing has changed for so many milliseconds: browsers refuse to write it every frame. */
const CALM = 300;

/** Keeps the page's address such that, copied, it shows the same cloud, picture and settings again. */
export class Address {
  /** The camera's place where that is not the usual one. */
  readonly #camera: () => CameraPlace | null;
  readonly #store: Store;
  /** `null`: a file from this device, which no address can open. */
  #cloud: { name: CloudName; usual: Usual } | null = null;
  /** What the address was of before a cloud was chosen that is not there yet. */
  #before: { cloud: { name: CloudName; usual: Usual } | null; href: string } | null = null;
  /** Whether the picture is divided only to show what the page is about. */
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

  /** From now on the address is that of this cloud. */
  begin(name: CloudName | null, usual: Usual): void {
    this.#cloud = name && { name, usual };
    this.#before = null;
    this.touch();
  }

  /** At once, for a cloud that is about to be loaded: what belonged to the one before goes. */
  choose([parameter, value]: CloudName): void {
    this.#before ??= { cloud: this.#cloud, href: location.href };
    this.#cloud = null;
    const address = new URL(location.href);
    for (const name of ["src", "view", "target", "freeze", "light", "color", "size", "fov", "up"])
      address.searchParams.delete(name);
    address.searchParams.set(parameter, value);
    replace(address);
  }

  /** What was chosen will not come: the cloud before it has stayed, and with it its address. */
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

  /** The page as it is now, for others to open; `null` where no address can. */
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
    // Whoever has done nothing yet is shown it again the next time.
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

/** Every parameter with its values; none where the setting is the usual one. */
function settingsInAddress(now: Settings, usual: Usual): Record<string, string[]> {
  const unless = (usually: string | number, value: string | number) => (value === usually ? [] : [String(value)]);
  return {
    exponent: "exponent" in now.radius ? [String(now.radius.exponent)] : [],
    radius: "exponent" in now.radius ? [] : unless("auto", radiusText(now.radius)),
    inversion: unless("spherical", inversionText(now.inversion)),
    viewpoints: unless("one", now.viewpoints),
    denoise: unless(0, now.denoise),
    vote: unless(0, now.vote),
    show: unless("points", now.show),
    edge: unless(USUAL_SETTINGS.edge, now.edge === Infinity ? "all" : now.edge),
    light: now.lights.map(String),
    soft: unless(USUAL_SETTINGS.soft, now.soft),
    ambient: unless(USUAL_SETTINGS.ambient, now.ambient),
    smoothing: unless(USUAL_SETTINGS.smoothing, now.smoothing),
    freeze: now.freeze ? [String(now.freeze)] : [],
    compare: now.compare === null ? [] : [String(now.compare)],
    against: now.compare === null ? [] : unless("all", now.against),
    splat: now.compare === null || now.against !== "zbuffer" ? [] : unless("auto", now.splat),
    hidden: unless("off", now.hidden),
    color: unless(USUAL_SETTINGS.color, now.color),
    size: unless(usual.size, now.size),
    fov: unless(usual.fieldOfView, now.fieldOfView),
    up: unless(usual.up, now.up),
    theme: unless(USUAL_SETTINGS.theme, now.theme),
  };
}

function cameraInAddress(camera: CameraPlace | null): Record<string, string[]> {
  return { view: camera ? [String(camera.view)] : [], target: camera?.target ? [String(camera.target)] : [] };
}

function radiusText(radius: Exclude<Radius, { exponent: number }>): string {
  return "rule" in radius ? radius.rule : String(radius.length);
}

export function inversionText(inversion: Inversion): string {
  if (inversion === "spherical") return inversion;
  const [kind, value] = "power" in inversion ? ["power", inversion.power] : ["exponential", inversion.exponential];
  return value === "auto" ? kind : `${kind}:${value}`;
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
