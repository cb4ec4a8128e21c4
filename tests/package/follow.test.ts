// How answers keep up with a camera. All adapters and the demo page share this code. The tests
// control the time, the questions and the answers. adapters.test.ts has what each adapter promises by it.
import { Group, PerspectiveCamera, Vector3 } from "three";
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";

import { HprError } from "../../src/ts/base/errors.js";
import { type Followed, Follower, Recovery, type RecoveryTimes, type Round } from "../../src/ts/follow/follower.js";
import { Readiness } from "../../src/ts/follow/events.js";
import { Refinement } from "../../src/ts/follow/view.js";
import { FollowedCameras } from "../../src/ts/three/cameras.js";
import { type Cloud, see } from "../../src/ts/worker/followed-cloud.js";

const LOST = new HprError("internal", "the worker died");

beforeEach(() => {
  vi.useFakeTimers({ toFake: ["setTimeout", "clearTimeout", "performance"] });
});

afterEach(() => {
  vi.useRealTimers();
});

/** Lets the handlers of settled promises run. */
const settled = () => new Promise((resolve) => setImmediate(resolve));

/** A question that was asked: the test answers it. */
interface Asked {
  question: string;
  overtaken: AbortSignal;
  answer: (answer: string) => void;
  refuse: (error: Error) => void;
}

/** The newest of several questions. One that was taken hears that another has overtaken it. */
class Newest {
  #wanted: string | undefined;
  #asked: string | undefined;
  #overtaking = new AbortController();

  get isNew(): boolean {
    return this.#wanted !== this.#asked;
  }

  get signal(): AbortSignal {
    return this.#overtaking.signal;
  }

  want(question: string): void {
    this.#wanted = question;
    if (this.isNew) this.#overtaking.abort();
  }

  take(): string {
    this.#overtaking = new AbortController();
    return (this.#asked = this.#wanted)!;
  }

  forget(): void {
    this.#asked = undefined;
  }
}

/** Something that moves, its follower, and a record of all that happens. */
class Scene {
  readonly asked: Asked[] = [];
  readonly log: string[] = [];
  readonly newest = new Newest();
  readonly follower: Follower;
  /** For a question: the value that is returned at once, or the error that is thrown, instead of a promise. */
  readonly atOnce = new Map<string, string | Error>();
  /** The error that a listener throws. */
  thrownByListener: Error | undefined;

  constructor(times?: RecoveryTimes) {
    const course: Followed = {
      next: () => (this.newest.isNew ? this.round() : undefined),
      refused: (error, again) => {
        this.log.push(`${error.message}${again ? " again" : ""}`);
        if (this.thrownByListener !== undefined) throw this.thrownByListener;
      },
    };
    if (times !== undefined) {
      course.lost = (isComingBack) => {
        this.log.push(isComingBack ? "lost" : "lost for good");
        this.newest.forget();
      };
    }
    this.follower = new Follower(course, times);
  }

  /** One frame. */
  see(question: string): void {
    this.newest.want(question);
    this.follower.follow();
  }

  get questions(): string[] {
    return this.asked.map(({ question }) => question);
  }

  get last(): Asked {
    return this.asked.at(-1)!;
  }

  round(): Round<string> {
    const question = this.newest.take();
    const overtaken = this.newest.signal;
    return {
      ask: () => {
        const ready = this.atOnce.get(question);
        if (ready instanceof Error) throw ready;
        if (ready !== undefined) return ready;
        return new Promise<string>((answer, refuse) => {
          this.asked.push({ question, overtaken, answer, refuse });
        });
      },
      use: (answer) => {
        if (answer === "unusable") throw new Error("cannot be drawn");
        this.log.push(`${question}: ${answer}`);
        this.follower.answered();
        return () => {
          this.log.push(`told ${question}`);
          if (this.thrownByListener !== undefined) throw this.thrownByListener;
        };
      },
      isGivenUp: (error) => {
        if (error !== overtaken.reason) return false;
        this.log.push(`${question} given up`);
        this.newest.forget();
        return true;
      },
      leave: (answer) => {
        this.log.push(`${answer} left`);
      },
    };
  }
}

describe("a follower", () => {
  let scene: Scene;

  beforeEach(() => {
    scene = new Scene();
  });

  it("asks one question at a time, and then the newest", async () => {
    for (const view of ["a", "b", "c", "d"]) scene.see(view);
    expect(scene.questions).toEqual(["a"]);
    expect(scene.follower.isBusy).toBe(true);
    scene.last.answer("1");
    await settled();
    expect(scene.questions).toEqual(["a", "d"]);
    scene.last.answer("2");
    await settled();
    expect(scene.log).toEqual(["a: 1", "told a", "d: 2", "told d"]);
    expect(scene.follower.isBusy).toBe(false);
  });

  it("reports an answer when the next question is on its way, even if listeners throw", async () => {
    const unhandled: unknown[] = [];
    const listener = (error: unknown) => unhandled.push(error);
    process.on("unhandledRejection", listener);
    scene.see("a");
    scene.see("b");
    scene.thrownByListener = new Error("a listener's own");
    scene.last.answer("1");
    await settled();
    expect(scene.questions).toEqual(["a", "b"]);
    expect(scene.log).toEqual(["a: 1", "told a"]);
    await settled();
    process.off("unhandledRejection", listener);
    expect(unhandled).toEqual([scene.thrownByListener]);
  });

  it("answers at once where that is possible, and passes the errors of listeners to the caller", () => {
    scene.atOnce.set("a", "1").set("b", "2");
    scene.see("a");
    expect(scene.log).toEqual(["a: 1", "told a"]);
    expect(scene.follower.isBusy).toBe(false);
    scene.thrownByListener = new Error("a listener's own");
    expect(() => scene.see("b")).toThrow(scene.thrownByListener);
    expect(scene.log).toEqual(["a: 1", "told a", "b: 2", "told b"]);
  });

  it("aborts the signal of a question that is overtaken, and uses its answer if it still comes", async () => {
    scene.see("a");
    const [first] = scene.asked;
    scene.see("a");
    expect(first!.overtaken.aborted).toBe(false);
    scene.see("b");
    expect(first!.overtaken.aborted).toBe(true);
    first!.answer("1");
    await settled();
    expect(scene.log).toEqual(["a: 1", "told a"]);
    expect(scene.questions).toEqual(["a", "b"]);
    expect(scene.last.overtaken.aborted).toBe(false);
  });

  it.each([
    ["the newer one", ["b"], ["a", "b"]],
    ["the same question, if the view has come back", ["b", "a"], ["a", "a"]],
  ])("goes on from a question that was given up to %s, without a report", async (_, views, questions) => {
    scene.see("a");
    const [first] = scene.asked;
    for (const view of views) scene.see(view);
    first!.refuse(first!.overtaken.reason as DOMException);
    await settled();
    expect(scene.questions).toEqual(questions);
    expect(scene.log).toEqual(["a given up"]);
  });

  it("asks by itself for a view that came while another was refused, even if a listener throws", async () => {
    const unhandled: unknown[] = [];
    const listener = (error: unknown) => unhandled.push(error);
    process.on("unhandledRejection", listener);
    scene.see("a");
    scene.see("b");
    scene.thrownByListener = new Error("a listener's own");
    scene.last.refuse(new Error("refused"));
    await settled();
    expect(scene.questions).toEqual(["a", "b"]);
    expect(scene.log).toEqual(["refused"]);
    await settled();
    process.off("unhandledRejection", listener);
    expect(unhandled).toEqual([scene.thrownByListener]);
  });

  it("treats an error thrown while asking or drawing as a refusal", async () => {
    scene.atOnce.set("a", new Error("wrong at once"));
    scene.see("a");
    scene.see("b");
    scene.last.answer("unusable");
    await settled();
    expect(scene.log).toEqual(["wrong at once", "cannot be drawn again"]);
    scene.see("c");
    scene.last.refuse("no error" as unknown as Error);
    await settled();
    expect(scene.log.at(-1)).toBe("no error again");
  });

  it("throws the first refusal if it is told to", () => {
    scene.atOnce.set("a", new Error("wrong at once"));
    scene.newest.want("a");
    expect(() => scene.follower.follow(true)).toThrow("wrong at once");
    expect(scene.log).toEqual([]);
  });

  it.each([
    [
      "leaves an answer",
      (asked: Asked) => {
        asked.answer("1");
      },
      ["1 left"],
    ],
    [
      "says nothing of a refusal",
      (asked: Asked) => {
        asked.refuse(LOST);
      },
      [],
    ],
  ])("%s that comes after the end, and asks nothing more", async (_, settle, log) => {
    scene = new Scene({ delays: [0], pause: 0, longPause: 0 });
    scene.see("a");
    scene.see("b");
    scene.follower.stop();
    settle(scene.last);
    await settled();
    scene.see("c");
    scene.follower.refuse(new Error("refused"));
    vi.advanceTimersByTime(1000);
    expect(scene.questions).toEqual(["a"]);
    expect(scene.log).toEqual(log);
  });

  it("may answer one view in several rounds, each better than the last, until another view is wanted", async () => {
    const stages = ["map", "exact"];
    let [stage, view] = [0, "a"];
    const asked: string[] = [];
    const follower = new Follower({
      next: () => {
        const question = stages[stage] === undefined ? undefined : `${view} ${stages[stage++]!}`;
        return question === undefined
          ? undefined
          : { ask: () => Promise.resolve(asked.push(question)), use: () => undefined };
      },
      refused: () => undefined,
    });
    follower.follow();
    expect(asked).toEqual(["a map"]);
    [stage, view] = [0, "b"];
    await settled();
    expect(asked).toEqual(["a map", "b map", "b exact"]);
  });
});

describe("a lost worker is made again", () => {
  let made = 0;
  let recovery: Recovery;

  beforeEach(() => {
    made = 0;
    recovery = new Recovery(() => made++);
  });

  /** For this many milliseconds, loses each new worker as soon as it is made. Returns the times of the losses. */
  function lose(milliseconds: number, wish?: boolean): number[] {
    const times: number[] = [];
    let before = made;
    for (let now = 0; now < milliseconds; now += 10) {
      vi.advanceTimersByTime(10);
      if (wish !== undefined) recovery.wish(wish);
      if (made > before) {
        before = made;
        times.push(now + 10);
        recovery.notices(LOST);
      }
    }
    return times;
  }

  it("at once, then after growing delays, then no longer by itself", () => {
    expect(recovery.notices(LOST)).toBe(true);
    expect(recovery).toMatchObject({ isLost: true, isUnderWay: true });
    expect(lose(60_000)).toEqual([10, 210, 1210]);
    expect(recovery).toMatchObject({ isLost: true, isUnderWay: false });
  });

  it.each([
    [true, [10, 210, 1210, 2210, 3210, 4210]],
    [false, [10, 210, 1210]],
  ])("then after pauses, while somebody wants it; another view: %s", (isNew, times) => {
    recovery.notices(LOST);
    expect(lose(5000, isNew)).toEqual(times);
    expect(lose(isNew ? 999 : 30_000, isNew)).toHaveLength(1);
  });

  it("at once again when there was an answer in between", () => {
    recovery.notices(LOST);
    lose(5000);
    vi.advanceTimersByTime(1000);
    recovery.wish(true);
    recovery.answered();
    expect(recovery.isLost).toBe(false);
    recovery.notices(LOST);
    expect(lose(5000)).toEqual([10, 210, 1210]);
  });

  it("not when it was another error, nor after the end", () => {
    expect(recovery.notices(new HprError("radius", "too small"))).toBe(false);
    expect(recovery.isLost).toBe(false);
    recovery.notices(LOST);
    recovery.stop();
    expect(lose(5000)).toEqual([]);
  });
});

describe("readiness", () => {
  it("is settled once", async () => {
    const readiness = new Readiness();
    readiness.resolve();
    readiness.reject(LOST, true);
    await expect(readiness.promise).resolves.toBeUndefined();
  });

  it("rejects if nobody listens, and reports later errors", async () => {
    const reject = vi.spyOn(Promise, "reject").mockReturnValue(Promise.resolve());
    const readiness = new Readiness();
    const rejected = expect(readiness.promise).rejects.toBe(LOST);
    readiness.reject(LOST, false);
    await rejected;
    expect(reject).not.toHaveBeenCalled();
    readiness.reject(LOST, true);
    expect(reject).not.toHaveBeenCalled();
    readiness.reject(LOST, false);
    expect(reject).toHaveBeenCalledExactlyOnceWith(LOST);
    reject.mockRestore();
  });
});

describe("maps", () => {
  it("have as many points as fit into a frame", () => {
    const refinement = new Refinement<undefined>(() => undefined);
    /** How many points each map should have, where maps take so many milliseconds. */
    const points = (...times: number[]) =>
      times.map((milliseconds) => {
        refinement.moved([{ kind: "map", options: undefined, rest: 0 }]);
        const round = refinement.round(
          (stage) => stage.points,
          () => undefined,
        );
        const asked = round.ask() as number;
        vi.advanceTimersByTime(milliseconds);
        round.use(asked);
        return asked;
      });
    const usual = 750_000;
    // One slow map alone changes nothing.
    expect(points(80, 14, 80, 14, 80, 5)).toEqual([usual, usual, usual, usual, usual, usual]);
    expect(points(20, 20, 18, 18, 15, 15)).toEqual([usual, usual, 600_000, 600_000, 480_000, 480_000]);
    expect(points(...Array<number>(30).fill(90)).at(-1)).toBe(50_000);
    expect(points(...Array<number>(30).fill(13)).at(-1)).toBe(50_000);
    expect(points(...Array<number>(30).fill(4)).at(-1)).toBe(usual);
  });

  it("are of what the camera sees, until it turns away", () => {
    const [map, looks] = [
      { kind: "map", options: {}, rest: 0 },
      { kind: "looks", options: {}, rest: 0 },
    ] as const;
    const settings = { stages: [looks], mapped: [map, looks], stale: "map" } as const;
    const nothing = () => undefined;
    const cameras = new FollowedCameras(settings, nothing, nothing, () => true);
    cameras.again(50_000, 0.01);
    // The cloud turns by 90 degrees about z, in other units.
    const points = new Group();
    points.rotation.z = Math.PI / 2;
    points.scale.setScalar(4);
    const camera = new PerspectiveCamera(40, 1.5);
    camera.position.set(8, 0, 0);
    const turned = (degrees: number) => {
      camera.rotation.y = (degrees * Math.PI) / 180;
      return cameras.look(cameras.of(camera), points);
    };
    /** Draws the answer that is due. Returns the options of a map. */
    const answered = () => {
      let asked: unknown;
      const cloud = {
        visibilityMap: (_: unknown, options: unknown) => (asked = options),
        visibleFrom: nothing,
      } as unknown as Cloud;
      const round = cameras.of(camera).see(
        "map",
        (place, stage) => see(cloud, place, stage),
        () => nothing,
      );
      round.use(round.ask() as never);
      return asked as { towards: { direction: number[]; angle: number } };
    };
    expect(turned(0)).toBe(true);
    const { direction, angle } = answered().towards;
    const axis = points.localToWorld(new Vector3(...direction)).normalize();
    for (const [x, y] of [
      [-1, -1],
      [1, -1],
      [-1, 1],
      [1, 1],
    ] as const) {
      const corner = new Vector3(x, y, 0).unproject(camera).sub(camera.position);
      expect(2 * axis.angleTo(corner) * (180 / Math.PI)).toBeCloseTo(angle - 30, 6);
    }
    expect(turned(14)).toBe(false);
    expect(turned(-16)).toBe(true);
    answered();
    expect(turned(-30)).toBe(false);
    camera.fov = 75;
    camera.updateProjectionMatrix();
    expect(turned(-30)).toBe(true);
    answered();
    // The answer at rest is of all directions.
    expect(answered()).toBeUndefined();
    expect(turned(150)).toBe(false);
  });
});
