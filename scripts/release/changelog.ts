/** The section of one version in the changelog. */
export interface Section {
  /** The day of the release. Undefined while the heading says "not yet released". */
  date?: string;
  body: string;
}

const UNRELEASED = "not yet released";

/** The section under `## VERSION, DATE`, if there is one. */
export function sectionOf(changelog: string, version: string): Section | undefined {
  const [, ...sections] = changelog.split(/^## /m);
  for (const section of sections) {
    const [heading = "", ...lines] = section.split("\n");
    const [, name, when = ""] = /^([^,\s]+), (.+)$/.exec(heading) ?? [];
    if (name !== version) continue;
    const body = lines.join("\n").trim();
    return when === UNRELEASED ? { body } : { date: when, body };
  }
  return undefined;
}

/** The changelog with the day of the release in the version's heading. */
export function dated(changelog: string, version: string, date: string): string {
  return changelog.replace(`## ${version}, ${UNRELEASED}\n`, `## ${version}, ${date}\n`);
}
