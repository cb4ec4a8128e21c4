import { MANY_ROWS, PLACEMENT_ROWS } from "./option-rows.js";
import type { Rows } from "./options.js";
import type { Placement } from "./placement.js";
import { type SeenBy, SeenByTask } from "./seen-by.js";
import {
  CoverageTask,
  PlacementTask,
  readPlacing,
  readSurvey,
  type Survey,
  type SurveyQuestion,
  type SurveyTask,
} from "./surveys.js";

interface Answers {
  coverage: Uint32Array;
  seenBy: SeenBy;
  placeViewpoints: Placement;
}

export type SurveyName = keyof Answers;

interface Method<Answer> {
  rows: Rows;
  task: (survey: Survey, given: Record<string, unknown>, progress?: (fraction: number) => void) => SurveyTask<Answer>;
}

/** The questions about many views, for `PointCloud` and for a cloud in a worker. */
export const SURVEYS: { [Name in SurveyName]: Method<Answers[Name]> } = {
  coverage: { rows: MANY_ROWS, task: (survey, _, progress) => new CoverageTask(survey, progress) },
  seenBy: { rows: MANY_ROWS, task: (survey, _, progress) => new SeenByTask(survey, progress) },
  placeViewpoints: {
    rows: PLACEMENT_ROWS,
    task: (survey, given, progress) => new PlacementTask(survey, readPlacing(given), progress),
  },
};

export function surveyQuestion<Name extends SurveyName>(
  name: Name,
  viewpoints: unknown,
  options: unknown,
): SurveyQuestion<Answers[Name]> {
  const { rows, task } = SURVEYS[name];
  return [
    name,
    options,
    rows,
    (dimension, given, progress) => task(readSurvey(dimension, viewpoints, given, name), given, progress),
  ];
}
