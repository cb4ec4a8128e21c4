// Properties of arguments that act while they are read: they change or dispose of the cloud, take memory, or throw.
import fc from "fast-check";
import { PointCloud } from "hidden-point-removal";
import { WorkerPointCloud } from "hidden-point-removal/worker";
import { transferredAway } from "./argument.js";
import { agree, judge, type Outcome, outcomeOf, require } from "./outcome.js";

type AnyCloud = PointCloud | WorkerPointCloud;
const START = Float64Array.from({ length: 90 }, (_, i) => Math.round(9 * Math.sin(i * i)));

/** A number that acts when it is read. */
const acting = (act: () => void, number: number) => ({
  length: 3,
  get 0() {
    act();
    return number;
  },
  1: 0,
  2: 9,
});

const SLOTS: Record<string, (cloud: AnyCloud, act: () => void) => unknown> = {
  "a viewpoint": (cloud, act) => cloud.visibleFrom(acting(act, 1)),
  "one viewpoint of several": (cloud, act) => cloud.visibleFromAny([[0, 0, 9], acting(act, 1)]),
  "a direction": (cloud, act) => cloud.visibleFromDirection(acting(act, 1)),
  "the viewpoint of a radius": (cloud, act) => cloud.autoRadius(acting(act, 1)),
  "an option": (cloud, act) =>
    cloud.visibleFrom([1, 0, 9], {
      get exponent() {
        act();
        return 2;
      },
    }),
  "an inversion": (cloud, act) =>
    cloud.visibleFrom([1, 0, 9], {
      inversion: {
        get power() {
          act();
          return 2;
        },
      },
    }),
  "the option of a mesh": (cloud, act) =>
    cloud.reconstruct([1, 0, 9], {
      get maxEdge() {
        act();
        return 20;
      },
    }),
  "a light": (cloud, act) => cloud.illuminate([acting(act, 1)], { triangles: Uint32Array.of(0, 1, 2) }),
};

const ACTIONS: Record<string, (cloud: AnyCloud) => unknown> = {
  dispose: (cloud) => cloud.dispose(),
  append: (cloud) => cloud.append([8, 8, 8]),
  remove: (cloud) => cloud.remove([3, 4]),
  ask: (cloud) => cloud.visibleFrom([5, 0, 0]),
  throw: () => {
    throw THROWN;
  },
};
const THROWN = new RangeError("the argument's own");

/** The answer is right for the cloud after its arguments have acted. */
export const actingArguments = fc.asyncProperty(
  fc.constantFrom(...Object.keys(SLOTS)),
  fc.constantFrom(...Object.keys(ACTIONS)),
  fc.boolean(),
  async (slot, action, remote) => {
    const cloud = remote ? await WorkerPointCloud.create(START, { shared: true }) : new PointCloud(START);
    const ask = SLOTS[slot]!;
    let result: unknown;
    const found = await outcomeOf(() =>
      ask(cloud, () => {
        result ??= ACTIONS[action]!(cloud);
      }),
    );
    await result;
    if (action === "throw") {
      require("refused" in found && found.error === THROWN, `${slot}: what it threw was not passed on`);
    } else if (action === "dispose") {
      judge(`${slot} that disposes`, { codes: ["disposed"], sure: true }, found);
    } else {
      agree(`${slot} that does ${action}`, found, await outcomeOf(() => ask(cloud, () => undefined)));
    }
    await cloud.dispose();
  },
);

/** Changes whose own arguments change the cloud. Each change takes effect once, or is refused as a whole. */
export const actingChanges = fc.asyncProperty(
  fc.constantFrom("append", "remove"),
  fc.constantFrom("dispose", "append", "remove", "throw"),
  fc.boolean(),
  async (change, action, remote) => {
    const cloud = remote ? await WorkerPointCloud.create(START, { shared: true }) : new PointCloud(START);
    let result: unknown;
    const list = acting(() => {
      result ??= ACTIONS[action]!(cloud);
    }, 1);
    const found = await outcomeOf(() => cloud[change](list));
    await result;
    const name = `${change} whose argument does ${action}`;
    if (action === "dispose") {
      judge(name, { codes: ["disposed"], sure: true }, found);
    } else if (action === "throw") {
      require("refused" in found && found.error === THROWN, `${name}: what it threw was not passed on`);
    } else {
      judge(name, { codes: [], sure: false }, found);
      const more = [change, action].filter((it) => it === "append").length;
      require(cloud.length === 30 + more, `${name}: length is ${cloud.length}`);
      agree(name, await outcomeOf(() => cloud.visibleFrom([0, 0, 9])), await expectedAfter(change, action));
    }
    await cloud.dispose();
  },
);

/** The outcome of the same changes with plain arguments, one after the other. The argument's change is the first. */
async function expectedAfter(change: string, action: string): Promise<Outcome> {
  const cloud = new PointCloud(START);
  await ACTIONS[action]!(cloud);
  cloud[change as "append" | "remove"]([1, 0, 9]);
  const outcome = await outcomeOf(() => cloud.visibleFrom([0, 0, 9]));
  cloud.dispose();
  return outcome;
}

/** Memory that the getter of an option takes away before the memory is read. */
export const disappearingMemory = fc.asyncProperty(
  fc.constantFrom("positions", "triangles", "indices"),
  fc.boolean(),
  async (what, remote) => {
    const positions = START.slice();
    if (what === "positions") {
      const stride = {
        get: () => {
          transferredAway(positions);
          return 3;
        },
      };
      const options = (own: object) => Object.defineProperty(own, "stride", stride);
      const create = () =>
        remote ? WorkerPointCloud.create(positions, options({ shared: true })) : new PointCloud(positions, options({}));
      judge(
        "a cloud of what its options take away",
        { codes: ["positions-type"], sure: true },
        await outcomeOf(create),
      );
      return;
    }
    const cloud = remote ? await WorkerPointCloud.create(positions, { shared: true }) : new PointCloud(positions);
    if (what === "triangles") {
      const triangles = Uint32Array.of(0, 1, 2);
      const light = acting(() => {
        if (triangles.length > 0) transferredAway(triangles);
      }, 1);
      const found = await outcomeOf(() => cloud.illuminate([light], { triangles }));
      judge("triangles that a light takes away", { codes: ["option"], sure: true }, found);
    } else {
      const answer = await cloud.visibleFrom([0, 0, 9]);
      transferredAway(answer.indices);
      judge(
        "the mask of an answer without indices",
        { codes: ["disposed"], sure: true },
        await outcomeOf(() => answer.mask()),
      );
    }
    require((await cloud.visibleFrom([0, 0, 9])).count > 0, "the cloud does not go on");
    await cloud.dispose();
  },
);
