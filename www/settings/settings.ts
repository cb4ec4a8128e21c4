import { type Setting, type SettingName, SETTINGS } from "./table.ts";

export type * from "./types.ts";
export { OWN_COLORS, USUAL_EDGE } from "./table.ts";

/** Everything that can be set on the page. The panel and the address change it. Questions and the picture use it. */
export type Settings = {
  [Name in SettingName]: (typeof SETTINGS)[Name] extends Setting<infer T> ? T : never;
};

export const USUAL_SETTINGS = Object.fromEntries(
  Object.entries(SETTINGS).map(([name, { usual }]) => [name, usual]),
) as unknown as Settings;

/** A row of the table, with the type that its setting has. */
export function rowOf<Name extends SettingName>(name: Name): Setting<Settings[Name]> {
  return SETTINGS[name] as unknown as Setting<Settings[Name]>;
}
