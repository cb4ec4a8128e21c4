// What becomes of a cloud when some of its workers refuse a request, or have no memory for a change.
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";

import { found, heldBy, scripted, useOwnWorkers, useScriptedWorkers } from "./scripted-workers";
import { bumpySphere, problemOf, readyPackage } from "./support";

const { WorkerPointCloud } = await readyPackage();

const points = bumpySphere(1, 100);
const farAway = [0, 0, 5];

beforeEach(useScriptedWorkers);
afterEach(() => {
  vi.restoreAllMocks();
  useOwnWorkers();
});

const cloudIn = (workers: number) => heldBy(workers, WorkerPointCloud.create(points, { workers }), 100);
/** The newest request to each worker. */
const newest = () => scripted.map(({ posted }) => posted.at(-1)!);

/** The cloud goes on: each worker answers the next view. */
async function expectAnswer(cloud: Awaited<ReturnType<typeof cloudIn>>) {
  const view = cloud.visibleFrom(farAway);
  scripted[0]!.answers(found([], 100));
  expect((await view).count).toBe(0);
}

describe("a change", () => {
  it.each(["append", "remove"] as const)("by %s is for all workers; who has no memory for it leaves", async (kind) => {
    const cloud = await cloudIn(3);
    const change = kind === "append" ? cloud.append(points) : cloud.remove([1, 2]);
    const numbers = kind === "append" ? points : Uint32Array.of(1, 2);
    const sent = kind === "append" ? { positions: numbers } : { indices: numbers };
    for (const { posted, moved } of scripted) {
      expect(posted.at(-1)).toEqual({ kind, module: undefined, ...sent });
      expect(moved.at(-1)).toEqual([numbers.byteLength]);
    }
    const size = { length: 200, skipped: 0, spacing: 1 };
    scripted[0]!.answers(size);
    scripted[1]!.refuses("too-large", "no memory");
    expect(cloud.length).toBe(100);
    scripted[2]!.answers(size);
    await change;
    expect(cloud.length).toBe(200);
    expect(scripted.map(({ isEnded }) => isEnded)).toEqual([false, true, false]);
    // The views of a survey are for those who are left.
    const asked = cloud.coverage([farAway, farAway]);
    await new Promise((resolve) => setImmediate(resolve));
    expect(newest().map((request) => request.kind)).toEqual(["visibleFrom", kind, "visibleFrom"]);
    scripted[0]!.answers(found([130], 200));
    scripted[2]!.answers(found([2], 200));
    expect((await asked).filter((count) => count > 0)).toHaveLength(2);
  });

  it.each(["append", "remove"] as const)(
    "by %s is refused if all workers refuse it, and nobody leaves",
    async (kind) => {
      const cloud = await cloudIn(2);
      const change = kind === "append" ? cloud.append(points) : cloud.remove([100]);
      scripted[1]!.refuses("option", "second");
      scripted[0]!.refuses("option", "first");
      expect(await problemOf(() => change)).toMatchObject({ code: "option", message: "first" });
      expect(scripted.map(({ isEnded }) => isEnded)).toEqual([false, false]);
      await expectAnswer(cloud);
    },
  );

  it.each(["append", "remove"] as const)("by %s that loses a worker ends the cloud", async (kind) => {
    const cloud = await cloudIn(2);
    const change = kind === "append" ? cloud.append(points) : cloud.remove([1]);
    scripted[0]!.answers({ length: 200, skipped: 0, spacing: 1 });
    scripted[1]!.refuses("internal", "a trap");
    expect(await problemOf(() => change)).toMatchObject({ code: "internal", message: "a trap" });
    expect(scripted.map(({ isEnded }) => isEnded)).toEqual([true, true]);
  });

  it("is asked of nobody if there is no memory for the copies", async () => {
    const cloud = await cloudIn(2);
    const copy = vi.spyOn(Uint32Array.prototype, "slice").mockImplementation(() => {
      throw new RangeError("Array buffer allocation failed");
    });
    const change = problemOf(() => cloud.remove([1]));
    expect(copy).toHaveBeenCalled();
    copy.mockRestore();
    expect(await change).toMatchObject({ code: "too-large" });
    expect(newest().map(({ kind }) => kind)).toEqual(["create", "create"]);
    await expectAnswer(cloud);
  });
});
