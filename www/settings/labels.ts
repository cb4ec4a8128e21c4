import type { SettingName } from "./table.ts";

/** The labels of the choices in the panel, by the text of each choice. index.html is made from them. */
export const LABELS: Partial<Record<SettingName, Readonly<Record<string, string>>>> = {
  looks: { 0: "One hull", 2: "2 looks", 3: "3 looks" },
  hidden: { off: "Hide", dimmed: "Ghost", shown: "Highlight" },
  up: { y: "Y", z: "Z", "-y": "−Y" },
  theme: { system: "System", dark: "Dark", light: "Light" },
};
