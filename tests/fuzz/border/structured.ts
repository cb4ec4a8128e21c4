// Properties of structured clouds: a shared worker and several workers answer every question with the bits of one
// instance on this thread, or refuse it with the same code and the same message.
import fc from "fast-check";
import { PointCloud } from "hidden-point-removal";
import { WorkerPointCloud } from "hidden-point-removal/worker";
import { agreeInWords, outcomeOf } from "./outcome.js";
import { question } from "./questions.js";
import { scene } from "./scenes.js";

const loose = (value: unknown) => value as never;

const plan = scene.chain((scene) =>
  fc.record({
    scene: fc.constant(scene),
    workers: fc.constantFrom(2, 3),
    /** All questions are asked before the first answer is awaited. */
    atOnce: fc.boolean(),
    questions: fc.array(question(scene), { minLength: 8, maxLength: 24 }),
  }),
);

export const structured = fc.asyncProperty(plan, async ({ scene, workers, atOnce, questions }) => {
  const make = () => loose(scene.points.make());
  const options = scene.skips ? ({ nonFinite: "skip" } as const) : {};
  const here = new PointCloud(make(), options);
  const others: Record<string, WorkerPointCloud> = {
    "a shared worker": await WorkerPointCloud.create(make(), { ...options, shared: true }),
    [`${workers} workers`]: await WorkerPointCloud.create(make(), { ...options, workers }),
  };
  try {
    for (const [name, cloud] of Object.entries(others)) {
      const asked: (() => Promise<void>)[] = [];
      for (const { name: what, on } of questions) {
        const found = outcomeOf(() => on(cloud));
        if (!atOnce) await found;
        asked.push(async () => {
          // A new cloud each time: an answer never depends on the questions before it.
          const fresh = new PointCloud(make(), options);
          agreeInWords(`${scene.name}, ${name}: ${what}`, await found, await outcomeOf(() => on(fresh)));
          fresh.dispose();
          agreeInWords(
            `${scene.name}, ${name}, and one cloud for all: ${what}`,
            await found,
            await outcomeOf(() => on(here)),
          );
        });
      }
      for (const check of asked) await check();
    }
  } finally {
    here.dispose();
    for (const cloud of Object.values(others)) await cloud.dispose();
  }
});
