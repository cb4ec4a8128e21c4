import { readFileSync } from "node:fs";
import { join } from "node:path";

/** The reasons why npm cannot sign where the package was built. Only a build service can confirm that place. */
export function provenanceRefusals(root: string): string[] {
  const { repository } = JSON.parse(readFileSync(join(root, "package.json"), "utf8")) as { repository?: unknown };
  const reasons: string[] = [];
  if (repository === undefined) {
    reasons.push("package.json has no `repository`, which npm compares with the place of the build.");
  }
  const vouched = process.env["GITHUB_ACTIONS"] !== undefined || process.env["GITLAB_CI"] !== undefined;
  if (!vouched) reasons.push("npm signs only builds of GitHub Actions or GitLab CI: run this command there.");
  return reasons;
}
