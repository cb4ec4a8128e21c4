// From where the command looks, how, and what it writes.
import { describe, expect, it } from "vitest";

import type { VisibilityOptions } from "hidden-point-removal";
import { readArguments } from "../../src/ts/cli/arguments";
import { VIEW_FLAGS } from "../../src/ts/cli/flags";
import { init } from "../../src/ts/index";
import { UsageProblem } from "../../src/ts/cli/values";
import { commandIn, numpy } from "./command-support";
import { bumpySphere, readyPackage } from "./support";

const { PointCloud, cameraFromPose, intrinsicsFromFieldOfView } = await readyPackage();
const { run, spawned, write, read, lines } = commandIn("command-views");
await init();

const COUNT = 1500;
const sphere = bumpySphere(11, COUNT);
const cloud = new PointCloud(Float64Array.from(sphere));
write("in.xyz", Array.from({ length: COUNT }, (_, i) => `${sphere.subarray(3 * i, 3 * i + 3).join(" ")}\n`).join(""));

const VIEWPOINT = [-1, 2, 5];
const FROM = ["in.xyz", "--from", VIEWPOINT.join(",")];
const PLACES = { front: [0, 0, 4], back: [0, 0.5, -4], inside: [0.1, 0, 0] };
write("places.csv", `name,x,y,z\n${Object.entries(PLACES).map(([name, at]) => `${name},${at.join(",")}\n`).join("")}`); // prettier-ignore

async function done(...args: string[]): Promise<void> {
  const { stderr, status } = await run(...args);
  expect(status, stderr).toBe(0);
}

/** The message about wrong usage. The command prints it and ends with 2, as command.test.ts shows. */
function refused(...args: string[]): string {
  try {
    readArguments(args.includes("-o") ? args : [...args, "-o", "never.xyz"]);
  } catch (error) {
    if (error instanceof UsageProblem) return error.message;
  }
  throw new Error("it was accepted");
}

const numbers = (name: string) => lines(name).map(Number);

describe("the options of a view have the effect of the library's", () => {
  const OPTIONS: [string[], VisibilityOptions][] = [
    [["--radius", "40"], { radius: 40 }],
    [["--radius", "opposite"], { radius: "opposite" }],
    [["--exponent", "1"], { exponent: 1 }],
    [["--inversion", "power:2.5"], { inversion: { power: 2.5 } }],
    [["--inversion", "exponential:0.01"], { inversion: { exponential: 0.01 } }],
    [["--inversion", "exponential:auto"], { inversion: { exponential: "auto" } }],
    [["--looks", "2"], { looks: 2 }],
    [["--looks", "3"], { looks: 3 }],
    [["--thickness", "0"], { looks: 3, thickness: 0 }],
    [["--thickness", "0.2"], { looks: 3, thickness: 0.2 }],
    [["--surface", "noisy"], { looks: 3, surface: "noisy" }],
    [["--within", "4"], { looks: 3, within: { distance: 4 } }],
    [
      ["--exponent", "1", "--within", "-1,-1,-1,1,1,0"],
      {
        exponent: 1,
        within: {
          box: [
            [-1, -1, -1],
            [1, 1, 0],
          ],
        },
      },
    ],
  ];
  it("each of the table has a row here", () => {
    const tried = new Set(OPTIONS.flatMap(([args]) => args.filter((word) => word.startsWith("--"))));
    expect([...tried].sort()).toEqual(VIEW_FLAGS.map(([name]) => `--${name}`).sort());
  });

  const usual = [...cloud.visibleFrom(VIEWPOINT).indices];
  it.each(OPTIONS)("%j", async (args, options) => {
    await done(...FROM, ...args, "-o", "view.idx");
    const expected = [...cloud.visibleFrom(VIEWPOINT, options).indices];
    expect(numbers("view.idx")).toEqual(expected);
    expect(expected).not.toEqual(usual);
  });

  it("--radius auto, --exponent auto, --inversion spherical and --looks 0 ask for the operator alone", async () => {
    for (const args of [
      ["--radius", "auto"],
      ["--exponent", "auto"],
      ["--inversion", "spherical"],
      ["--looks", "0"],
    ]) {
      await done(...FROM, ...args, "-o", "view.idx");
      expect(numbers("view.idx")).toEqual(usual);
    }
  });

  it("--score-threshold, and the scores themselves", async () => {
    const { scores } = cloud.visibleFrom(VIEWPOINT, { looks: 3, scores: true });
    await done(...FROM, "--looks", "3", "--format", "scores", "-o", "scores.npy");
    const { header, data } = numpy(read("scores.npy"));
    expect(header).toBe(`{'descr': '<f4', 'fortran_order': False, 'shape': (${COUNT},), }`);
    expect(data.equals(Buffer.from(scores.buffer))).toBe(true);
    const above = (threshold: number) => [...scores.keys()].filter((i) => scores[i]! >= threshold);
    for (const threshold of [0.25, 0.75]) {
      await done(...FROM, "--looks", "3", "--score-threshold", String(threshold), "-o", "view.idx");
      expect(numbers("view.idx")).toEqual(above(threshold));
    }
    expect(above(0.25).length).toBeGreaterThan(above(0.75).length);
  });
});

describe("masks", () => {
  const mask = cloud.visibleFrom(VIEWPOINT, { looks: 3 }).mask();
  it("are text, or a mask of NumPy", async () => {
    await done(...FROM, "-o", "seen.mask");
    expect(numbers("seen.mask")).toEqual([...mask]);
    await done(...FROM, "-o", "seen.npy");
    const { header, data } = numpy(read("seen.npy"));
    expect(header).toBe(`{'descr': '|b1', 'fortran_order': False, 'shape': (${COUNT},), }`);
    expect([...data]).toEqual([...mask]);
    expect(spawned(...FROM, "--format", "mask", "-o", "-").stdout.toString()).toBe([...mask, ""].join("\n"));
  });
});

describe("--cameras with one camera", () => {
  const camera = cameraFromPose([0, 0, 4], [1, 0, 0, 0], {
    ...intrinsicsFromFieldOfView(30, 320, 240),
    distortion: [0.1, -0.01, 0.001, 0.002, 0],
  });
  write("camera.json", JSON.stringify(camera));
  const view = cloud.visibleFromCamera(camera, { looks: 3 });

  it("writes index, pixel and depth of each visible point in the image", async () => {
    expect(view.count).toBeGreaterThan(50);
    await done("in.xyz", "--cameras", "camera.json", "--format", "pixels", "-o", "seen.csv");
    const [names, ...rows] = lines("seen.csv");
    expect(names).toBe("index,u,v,depth");
    const found = rows.map((row) => row.split(",").map(Number));
    expect(found.map(([index]) => index)).toEqual([...view.indices]);
    found.forEach(([, u, v, depth], i) => {
      expect([u!, v!, depth!].map(Math.fround)).toEqual([view.pixels[2 * i], view.pixels[2 * i + 1], view.depths[i]]);
    });
    await done("in.xyz", "--cameras", "camera.json", "--format", "pixels", "-o", "seen-camera.npy", "--looks", "2");
    const looked = cloud.visibleFromCamera(camera, { looks: 2 });
    const { header, data } = numpy(read("seen-camera.npy"));
    expect(header).toContain(`'<f8', 'fortran_order': False, 'shape': (${looked.count}, 4)`);
    expect(looked.indices[7]).toBe(data.readDoubleLE(8 * 4 * 7));
  });

  it("writes the points themselves, or their indices, if that is wanted", async () => {
    await done("in.xyz", "--cameras", "camera.json", "-o", "seen.xyz");
    const all = lines("in.xyz");
    expect(lines("seen.xyz")).toEqual([...view.indices].map((i) => all[i]));
    await done("in.xyz", "--cameras", "camera.json", "-o", "seen.idx");
    expect(numbers("seen.idx")).toEqual([...view.indices]);
  });

  it.each([
    ["prose.json", "a camera", /none of the files of cameras/],
    ["bent.json", JSON.stringify({ ...camera, cameraToWorld: new Array(16).fill(1) }), /pose/],
    ["odd.json", JSON.stringify({ ...camera, zoom: 2 }), /unknown option "zoom"/],
    ["sizeless.json", JSON.stringify({ ...camera, width: 0 }), /width/],
  ])("%s is refused", async (name, content, says) => {
    write(name, content);
    const { stderr, status } = await run("in.xyz", "--cameras", name, "--format", "pixels", "-o", "seen.csv");
    expect([status, stderr]).toEqual([1, expect.stringMatching(says)]);
  });
});

describe("--viewpoints", () => {
  const places = Object.values(PLACES);
  it("writes what any of them sees", async () => {
    await done("in.xyz", "--viewpoints", "places.csv", "--exponent", "2", "-o", "any.idx");
    expect(numbers("any.idx")).toEqual([...cloud.visibleFromAny(places, { exponent: 2 }).indices]);
  });

  it("--coverage counts the viewpoints that see each point", async () => {
    await done("in.xyz", "--viewpoints", "places.csv", "--coverage", "-o", "counts.txt");
    const counts = cloud.coverage(places, { looks: 3 });
    expect(numbers("counts.txt")).toEqual([...counts]);
    await done("in.xyz", "--viewpoints", "places.csv", "--coverage", "-o", "counts.npy");
    expect(numpy(read("counts.npy")).data.equals(Buffer.from(counts.buffer))).toBe(true);
  });

  it("{name} in the name of the output makes one file for each", async () => {
    await done("in.xyz", "--viewpoints", "places.csv", "-o", "seen-{name}.xyz");
    const all = lines("in.xyz");
    for (const [name, at] of Object.entries(PLACES)) {
      expect(lines(`seen-${name}.xyz`)).toEqual([...cloud.visibleFrom(at, { looks: 3 }).indices].map((i) => all[i]));
    }
    await done(
      "in.xyz",
      "--viewpoints",
      "places.csv",
      "--looks",
      "3",
      "--score-threshold",
      "0.6",
      "-o",
      "sure-{name}.mask",
    );
    const { scores } = cloud.visibleFrom(PLACES.back, { looks: 3, scores: true });
    expect(numbers("sure-back.mask")).toEqual([...scores].map((score) => (score >= Math.fround(0.6) ? 1 : 0)));
  });

  it.each([
    ["x,y,z\n0,0,4\n0,0.5,-4\n0.1,0,0\n", ["1", "2", "3"]],
    ["0 0 4\n0 0.5 -4\n0.1 0 0\n", ["1", "2", "3"]],
    ["# by hand\nfront;0;0;4\nback;0;0.5;-4\ninside;0.1;0;0\n", ["front", "back", "inside"]],
    ["z,name,x,y\n4,10,0,0\n-4,20,0,0.5\n0,30,0.1,0\n", ["10", "20", "30"]],
  ])("reads %j", async (content, names) => {
    write("table.csv", content);
    const { stderr } = await run("in.xyz", "--viewpoints", "table.csv", "-o", "each-{name}.idx");
    names.forEach((name, i) => {
      expect(numbers(`each-${name}.idx`)).toEqual([...cloud.visibleFrom(places[i]!, { looks: 3 }).indices]);
      expect(stderr).toContain(`points are visible from ${name}`);
    });
  });

  it.each([
    ["1,0,0,4\n2,0,0,5\n", /line 1 has 4 columns without names; begin with a line such as name,x,y,z/],
    ["name,x,y,z\na,0,0,4\na,0,0,5\n", /line 3 has a name a second time/],
    ["name,x,y,z\n../a,0,0,4\n", /line 2 has a name that no file can have/],
    ["x,y,z\n0,0,nan\n", /line 2 has a coordinate that is not finite/],
    ["x,y\n0,0\n", /line 1 is neither three numbers nor names/],
    ["", /no line of three numbers/],
  ])("refuses %j", async (content, says) => {
    write("wrong.csv", content);
    const { stderr, status } = await run("in.xyz", "--viewpoints", "wrong.csv", "-o", "each-{name}.idx");
    expect([status, stderr]).toEqual([1, expect.stringMatching(says)]);
    expect(stderr).toContain("wrong.csv cannot be read: ");
  });
});

describe("--progress", () => {
  it("writes lines where there is no terminal", async () => {
    const { stderr } = await run(...FROM, "--progress", "-o", "view.idx");
    expect(stderr.split("\n")).toEqual(expect.arrayContaining(["20 % understanding", "60 % looking"]));
    expect((await run(...FROM, "-o", "view.idx")).stderr).toMatch(/^\d+ of 1500 points are visible.*\n$/);
  });
});

describe("combinations without a meaning", () => {
  const LOOKS = ["--looks", "3"];
  it.each<[string[], RegExp]>([
    [["in.xyz"], /--from X,Y,Z is needed: the viewpoint; or --viewpoints or --cameras FILE/],
    [[...FROM, "--cameras", "c.json"], /--from and --cameras exclude each other/],
    [[...FROM, "--viewpoints", "places.csv"], /--from and --viewpoints exclude each other/],
    [[...FROM, "--radius", "9", "--exponent", "2"], /--radius and --exponent exclude each other/],
    [[...FROM, "--radius", "9", "--exponent", "auto"], /--radius and --exponent exclude each other/],
    [[...FROM, ...LOOKS, "--radius", "9"], /--looks and --radius exclude each other/],
    [[...FROM, ...LOOKS, "--exponent", "auto"], /--looks and --exponent exclude each other/],
    [[...FROM, ...LOOKS, "--inversion", "power:2"], /--looks and --inversion exclude each other/],
    [[...FROM, "--inversion", "power:2", "--exponent", "2"], /--exponent cannot be combined with inversion power/],
    [[...FROM, "--inversion", "power:2", "--radius", "opposite"], /--radius "opposite" cannot be combined with/],
    [
      [...FROM, "--inversion", "exponential:1", "--radius", "9"],
      /--radius cannot be combined with inversion exponential/,
    ],
    [[...FROM, "--looks", "0", "--score-threshold", "0.5"], /--score-threshold needs --looks 2 or 3/],
    [[...FROM, "--exponent", "2", "--format", "scores", "-o", "never.txt"], /--format scores needs --looks 2 or 3/],
    [[...FROM, ...LOOKS, "--score-threshold", "0.5", "--format", "scores", "-o", "never.txt"], /writes all scores/],
    [["in.xyz", "--viewpoints", "places.csv", ...LOOKS, "--score-threshold", "0.5"], /needs one viewpoint/],
    [[...FROM, "--coverage", "-o", "never.txt"], /--coverage needs --viewpoints FILE/],
    [["in.xyz", "--viewpoints", "p.csv", "--coverage", "--format", "mask", "-o", "never.txt"], /--format mask/],
    [
      ["in.xyz", "--viewpoints", "p.csv", "--coverage", "-o", "{name}.txt"],
      /--coverage cannot be combined with \{name/,
    ],
    [["in.xyz", "--viewpoints", "p.csv", "--coverage", "-o", "never.las"], /must end with .* for counts/],
    [[...FROM, "--format", "counts", "-o", "never.txt"], /--format counts needs --coverage/],
    [[...FROM, "--format", "pixels", "-o", "never.csv"], /--format pixels needs --cameras FILE/],
    [[...FROM, "-o", "{name}.xyz"], /\{name\} in the name of the output needs --viewpoints/],
    [[...FROM, "--format", "points", "-o", "never.idx"], /must end with \.xyz, \.txt, \.csv, \.pts/],
    [[...FROM, "--format", "faces"], /--format needs one of points, indices, mask/],
    [[...FROM, "-o", "never.pcd"], /never\.pcd must end with \.xyz, .*: points of in\.xyz are not written to \.pcd/],
    [[...FROM, "--radius", "-3"], /--radius must be finite and positive, got -3/],
    [[...FROM, "--inversion", "power:1"], /--inversion power must be above 1 and at most 16, got 1/],
    [[...FROM, "--inversion", "exponential"], /--inversion must be/],
    [[...FROM, "--looks", "4"], /--looks must be an integer from 2 to 3, got 4/],
    [[...FROM, "--radius", "search"], /--radius must be a number, "auto" or "opposite", got "search"/],
    [[...FROM, "--surface", "rough"], /--surface must be "auto", "clean", "noisy" or "layered", got "rough"/],
    [[...FROM, "--looks", "0", "--thickness", "1"], /--thickness can be given only with looks/],
    [[...FROM, "--within", "1,2"], /--within needs a distance, or six numbers, as in/],
    [[...FROM, "--vote", "8"], /Unknown option '--vote'$/m],
    [[...FROM, "--from", "1,2,3"], /--from is given twice: several viewpoints stand in a file, --viewpoints FILE/],
    [[...FROM, "--looks", "3", "--looks", "2"], /--looks is given twice/],
    [[...FROM, ...LOOKS, "--score-threshold", "2"], /--score-threshold needs a number from 0 to 1/],
  ])("%j", (args, says) => {
    expect(refused(...args)).toMatch(says);
  });

  it("a radius that is too small for the cloud is not wrong usage", async () => {
    const { stderr, status } = await run(...FROM, "--radius", "1", "-o", "never.xyz");
    expect([status, stderr]).toEqual([1, expect.stringMatching(/radius 1 is smaller than the distance.*\(radius\)/)]);
  });
});

describe("--workers", () => {
  it("changes no answer", async () => {
    const many = ["in.xyz", "--viewpoints", "places.csv", "--coverage", "--exponent", "2"];
    await done(...many, "-o", "one.txt");
    await done(...many, "--workers", "3", "-o", "three.txt");
    expect(numbers("three.txt")).toEqual(numbers("one.txt"));
  });

  it.each(["0", "65", "1.5", "-1", "many"])("refuses %s", (workers) => {
    expect(refused(...FROM, "--workers", workers)).toBe(`--workers needs a whole number from 1 to 64, not ${workers}`);
  });
});
