import { type Setting, type SettingName, SETTINGS } from "./table.ts";

export type * from "./limits.ts";
export { OWN_COLORS } from "./table.ts";

/** Everything that can be set on the page. The panel and the address change it. Questions and the picture use it. */
export type Settings = {
  [Name in SettingName]: (typeof SETTINGS)[Name] extends Setting<infer T> ? T : never;
};

export const USUAL_SETTINGS = Object.fromEntries(
  Object.entries(SETTINGS).map(([name, { usual }]) => [name, usual]),
) as unknown as Settings;

/** Whether looks are possible with these settings. Each look has its own flip, so they exclude any other choice of it. */
export function canLook({ radius, inversion }: Pick<Settings, "radius" | "inversion">): boolean {
  return "rule" in radius && inversion === "spherical";
}

/** A radius or an inversion that is given asks for the operator of the paper, even if it is the usual one. */
export function withLooks(given: Partial<Settings>): Partial<Settings> {
  const asked = given.radius !== undefined || given.inversion !== undefined;
  return given.looks === undefined && asked && canLook({ ...USUAL_SETTINGS, ...given })
    ? { ...given, looks: 0 }
    : given;
}

/** A row of the table, with the type that its setting has. */
export function rowOf<Name extends SettingName>(name: Name): Setting<Settings[Name]> {
  return SETTINGS[name] as unknown as Setting<Settings[Name]>;
}

type Listener = (now: Settings, before: Settings) => void;

/** The present settings. Each change makes a new object. So if a value is the same object, it is unchanged. */
export class Store {
  #settings: Settings;
  readonly #listeners: Listener[] = [];

  constructor(settings: Settings) {
    this.#settings = settings;
  }

  get current(): Settings {
    return this.#settings;
  }

  change(part: Partial<Settings>): void {
    const before = this.#settings;
    this.#settings = { ...before, ...part };
    for (const listener of this.#listeners) listener(this.#settings, before);
  }

  /** Calls the listener with the settings now, and at every change from now on. */
  follow(listener: Listener): void {
    this.#listeners.push(listener);
    listener(this.#settings, this.#settings);
  }
}

/** The labels of the choices in the panel, by the text of each choice. */
export const LABELS = {
  looks: { 0: "One hull", 2: "2 looks", 3: "3 looks" },
  surface: { auto: "As found", clean: "Clean", noisy: "Noisy", layered: "Layered" },
  hidden: { off: "Hide", dimmed: "Ghost", shown: "Highlight" },
  up: { y: "Y", z: "Z", "-y": "−Y" },
  theme: { system: "System", dark: "Dark", light: "Light" },
} satisfies Partial<Record<SettingName, Readonly<Record<string, string>>>>;
