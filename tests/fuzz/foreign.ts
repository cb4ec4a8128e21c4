// Damaged files, read by readCloud and by readers of others: laspy with lazrs, plyfile, pypcd4, and three's loader of glTF.
// Written files, read by laspy, plyfile, three and Open3D, if the Python of OPEN3D_PYTHON, or python3, has it.
// If both read a file, they must read the same points. A file that only we read is listed.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { spawn, spawnSync } from "node:child_process";
import { readCloud, writeCloud } from "hidden-point-removal/files";
import { Color, type Mesh, MeshBasicMaterial, SRGBColorSpace, Vector3 } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { PLYLoader } from "three/addons/loaders/PLYLoader.js";

import { georeferencedBall } from "../browser/clouds";
import { glb, las } from "../browser/formats";
import { Random, validFile } from "../files/random";
import { pythonWith } from "./python";

const PACKAGES = ["laspy==2.7.0", "lazrs==0.8.2", "plyfile==1.1.5", "pypcd4==1.5.1"];
/** A foreign reader that is silent for so many milliseconds has refused the file. */
const PATIENCE = 20_000;

type Outcome = { points: Float64Array } | { refused: string };
type Kind = "las" | "ply" | "pcd" | "glb";

/** Tries damaged files for this many minutes and prints the counts. Returns how many were read differently. */
export async function fuzzForeign(minutes: number, seed: number): Promise<number> {
  const python = pythonWith("foreign", PACKAGES);
  if (python === undefined) console.log("skipped laspy, plyfile and pypcd4: there is no Python 3 with pip, or no PyPI");
  const foreign = python === undefined ? undefined : new Foreign(python);
  const kinds: Kind[] = foreign ? ["las", "las", "ply", "pcd", "glb"] : ["glb"];
  const open3d = open3dReader();
  let wrong = await written(foreign, open3d, new Random(seed));
  const tallies = new Map<string, Tally>();
  const end = Date.now() + 60_000 * minutes;
  for (let round = seed; Date.now() < end; round++) {
    const random = new Random(round);
    const kind = random.of(kinds);
    const { name, content } = fileOf(kind, random);
    const tally = tallies.get(name) ?? {
      both: 0,
      neither: 0,
      onlyThey: 0,
      onlyWe: new Map<string, number>(),
      wrong: 0,
    };
    tallies.set(name, tally);
    const ours = await own(content);
    const theirs = kind === "glb" ? await three(content) : await foreign!.read(kind, content);
    if ("points" in ours && "points" in theirs) {
      tally.both++;
      if (isSame(ours.points, theirs.points)) continue;
      tally.wrong++;
      console.log(`seed ${round}, ${name}: ${shown(ours)} here, ${shown(theirs)} there`);
    } else if ("points" in theirs) {
      tally.onlyThey++;
    } else if ("points" in ours) {
      const why = theirs.refused.replace(/\d+/g, "N").slice(0, 90);
      if (!tally.onlyWe.has(why)) console.log(`seed ${round}, ${name}: ${shown(ours)} here, “${theirs.refused}” there`);
      tally.onlyWe.set(why, (tally.onlyWe.get(why) ?? 0) + 1);
    } else {
      tally.neither++;
    }
  }
  foreign?.end();
  open3d?.end();
  for (const [name, { both, neither, onlyThey, onlyWe, wrong: own }] of tallies) {
    const we = [...onlyWe.values()].reduce((sum, count) => sum + count, 0);
    const tried = both + neither + onlyThey + we;
    console.log(
      `${name}: both ${both}, neither ${neither}, only they ${onlyThey}, only we ${we}; ${tried} cases, ${own} wrong`,
    );
    for (const [why, count] of onlyWe) console.log(`    ${count} × ${why}`);
    wrong += own;
  }
  return wrong;
}

/** Open3D is large, so it is not installed here. */
function open3dReader(): Foreign | undefined {
  const python = process.env["OPEN3D_PYTHON"] ?? "python3";
  const isThere = spawnSync(python, ["-c", "import open3d"], { stdio: "ignore" }).status === 0;
  if (isThere) return new Foreign(python, "open3d");
  console.log(`skipped Open3D: ${python} has none (OPEN3D_PYTHON may name another Python)`);
  return undefined;
}

/** Clouds that writeCloud has written, as others read them: points, colors and intensity. Returns how many differ. */
async function written(foreign: Foreign | undefined, open3d: Foreign | undefined, random: Random): Promise<number> {
  const readers = {
    ...(foreign && {
      plyfile: (file: Buffer) => foreign.read("plyw", file),
      laspy: (file: Buffer) => foreign.read("lasw", file),
    }),
    ...(open3d && { Open3D: (file: Buffer) => open3d.read("o3dw", file) }),
    three: (file: Buffer) => Promise.resolve(threePly(new Uint8Array(file))),
  };
  const [count, files] = [20, 120];
  let [wrong, tried] = [0, 0];
  for (let file = 0; file < files; file++) {
    const numbers = (length: number, most: number) => Array.from({ length }, () => random.below(most));
    const positions = Float64Array.from(numbers(3 * count, 2e6), (value) => value / 1000 + 5e5);
    const colors = Uint8Array.from(numbers(3 * count, 256));
    // Bytes, 16 bits, and the bytes and shares of tables.
    const kind = random.of(["bytes", "deep", "table", "shares"] as const);
    const scale = { bytes: 1, deep: 257, table: 1, shares: 1 / 255 }[kind];
    const channels = ["red", "green", "blue"].map((name, channel) => {
      const own = Float64Array.from({ length: count }, (_, i) => colors[3 * i + channel]! * scale);
      return [name, kind === "deep" ? Uint16Array.from(own) : own] as const;
    });
    const shares = random.below(2) === 0;
    const intensity = shares
      ? Float32Array.from(numbers(count, 65_536), (value) => value / 65_535)
      : Uint16Array.from(numbers(count, 65_536));
    const names = [
      "glow",
      "class flags",
      "Classification",
      "X",
      "gps_time",
      "a name that is longer than LAS has room for",
    ];
    const extra = { [random.of(names)]: Float64Array.from(numbers(count, 1e6), (value) => value / 7) };
    const columns = { ...(kind !== "bytes" && Object.fromEntries(channels)), intensity, ...extra };
    const cloud = { positions, columns, ...(kind === "bytes" && { colors }) };
    for (const [reader, read] of Object.entries(readers)) {
      const isLas = reader === "laspy";
      const found = await read(Buffer.from(writeCloud(cloud, isLas ? "las" : "ply")));
      tried++;
      const right = Float64Array.from({ length: 7 * count }, (_, k) => {
        const [i, column] = [Math.floor(k / 7), k % 7];
        if (column < 3) return positions[3 * i + column]!;
        if (column < 6) return colors[3 * i + column - 3]! * (isLas ? 257 : 1);
        return isLas && shares ? Math.round(intensity[i]! * 65_535) : intensity[i]!;
      });
      const isRight =
        "points" in found &&
        found.points.length === right.length &&
        found.points.every((value, k) => {
          const isLinear = reader === "three" && k % 7 >= 3 && k % 7 < 6;
          const wanted = isLinear ? 255 * new Color().setRGB(right[k]! / 255, 0, 0, SRGBColorSpace).r : right[k]!;
          return Math.abs(value - wanted) <= (isLinear ? 1 : isLas && k % 7 < 3 ? 1e-6 : 0);
        });
      if (isRight) continue;
      wrong++;
      const what = `${kind} and ${Object.keys(columns).join(", ")}`;
      console.log(`a file with ${what} is written wrongly for ${reader}: ${shown(found)}`);
    }
  }
  console.log(`written files, read by ${Object.keys(readers).join(", ")}: ${tried} cases, ${wrong} wrong`);
  return wrong;
}

/** The numbers of a PLY file as three's loader reads them: its colors are linear light, in bytes. */
function threePly(content: Uint8Array<ArrayBuffer>): Outcome {
  const loader = new PLYLoader();
  loader.setCustomPropertyNameMapping({ intensity: ["intensity"] });
  const { position, color, intensity } = loader.parse(content.buffer).attributes;
  if (!position || !color || !intensity) return { refused: "an attribute is missing" };
  const rows = Array.from({ length: position.count }, (_, i) => {
    const bytes = [color.getX(i), color.getY(i), color.getZ(i)].map((share) => 255 * share);
    return [position.getX(i), position.getY(i), position.getZ(i), ...bytes, intensity.getX(i)];
  });
  return { points: Float64Array.from(rows.flat()) };
}

interface Tally {
  both: number;
  neither: number;
  onlyThey: number;
  /** How often only we read a file, by the words of the foreign reader. */
  onlyWe: Map<string, number>;
  wrong: number;
}

const fixture = (name: string) => readFileSync(join(import.meta.dirname, "../browser/fixtures", name));

/** A valid file, mostly with changes. */
function fileOf(kind: Kind, random: Random): { name: string; content: Buffer } {
  if (kind === "las" || kind === "glb") {
    const name = kind === "glb" ? "glb" : random.of(["ball-12.laz", "ball-14.laz", "las 1.2", "las 1.4"]);
    const ball = georeferencedBall(200);
    const good =
      kind === "glb"
        ? Buffer.from(glb(ball.map((value, i) => value - ball[i % 3]!)))
        : name.endsWith("laz")
          ? fixture(name)
          : Buffer.from(name === "las 1.2" ? las(ball) : las(ball, { minor: 4, format: 7 }));
    return { name, content: damaged(good, random) };
  }
  for (;;) {
    const { name, kind: own, content } = validFile(random);
    if (name.endsWith(kind)) return { name: own, content: random.changed(content) };
  }
}

/** Changes bytes, half of them in the header, or cuts the file. */
function damaged(good: Buffer, random: Random): Buffer {
  const copy = Buffer.from(good);
  for (let changes = random.below(4); changes > 0; changes--) {
    const within = random.below(2) === 0 ? Math.min(600, copy.length) : copy.length;
    copy[random.below(within)] = random.of([random.below(256), 0, 255]);
  }
  return random.below(8) === 0 ? copy.subarray(0, random.below(copy.length)) : copy;
}

async function own(content: Buffer): Promise<Outcome> {
  try {
    const { positions } = await readCloud(new Uint8Array(content).buffer);
    return { points: Float64Array.from(positions) };
  } catch (error) {
    if ((error as { code?: string }).code !== "load") throw error;
    return { refused: (error as Error).message };
  }
}

async function three(content: Buffer): Promise<Outcome> {
  try {
    const loader = new GLTFLoader();
    // Materials need a browser.
    loader.register(() => ({ name: "no_materials", loadMaterial: () => Promise.resolve(new MeshBasicMaterial()) }));
    const { scene } = await loader.parseAsync(new Uint8Array(content).buffer, "");
    const points: number[] = [];
    scene.updateMatrixWorld(true);
    scene.traverse((object) => {
      const position = (object as Partial<Mesh>).geometry?.getAttribute("position");
      for (let i = 0; i < (position?.count ?? 0); i++) {
        points.push(...new Vector3().fromBufferAttribute(position!, i).applyMatrix4(object.matrixWorld).toArray());
      }
    });
    return points.length === 0 ? { refused: "no points" } : { points: Float64Array.from(points) };
  } catch (error) {
    return { refused: String(error) };
  }
}

/** An infinite number is no position, as NaN is none. */
function isSame(a: Float64Array, b: Float64Array): boolean {
  return (
    a.length === b.length && a.every((value, i) => value === b[i] || !(Number.isFinite(value) || Number.isFinite(b[i])))
  );
}

function shown(outcome: Outcome): string {
  if ("refused" in outcome) return `“${outcome.refused}”`;
  const { points } = outcome;
  return `${points.length / 3} points (${[...points.subarray(0, 12)].join(" ")})`;
}

/** A Python process that reads one file after another. It is started again when it dies. */
class Foreign {
  readonly #python: string;
  readonly #readers: string;
  #process;
  #bytes = Buffer.alloc(0);
  #wake: () => void = () => undefined;

  /** @param readers those of foreign.py that are wanted, if not all but Open3D */
  constructor(python: string, readers = "") {
    [this.#python, this.#readers] = [python, readers];
    this.#process = this.#start();
  }

  async read(kind: string, content: Buffer): Promise<Outcome> {
    const head = Buffer.alloc(8);
    head.write(kind.padEnd(4), "latin1");
    head.writeUInt32LE(content.length, 4);
    this.#process.stdin.write(Buffer.concat([head, content]));
    const count = (await this.#take(4))?.readInt32LE();
    if (count === undefined) return { refused: "the reader died, or was silent for too long" };
    if (count >= 0) {
      const points = await this.#take(8 * count);
      return points ? { points: new Float64Array(new Uint8Array(points).buffer) } : { refused: "the reader died" };
    }
    const message = await this.#take((await this.#take(4))!.readInt32LE());
    return { refused: message!.toString("utf8") };
  }

  end(): void {
    this.#process.kill();
  }

  async #take(length: number): Promise<Buffer | undefined> {
    const until = Date.now() + PATIENCE;
    while (this.#bytes.length < length) {
      if (this.#process.exitCode !== null || this.#process.signalCode !== null || Date.now() > until) {
        this.#process.kill("SIGKILL");
        this.#bytes = Buffer.alloc(0);
        this.#process = this.#start();
        return undefined;
      }
      await new Promise<void>((resolve) => {
        this.#wake = resolve;
        setTimeout(resolve, 500).unref();
      });
    }
    const taken = this.#bytes.subarray(0, length);
    this.#bytes = this.#bytes.subarray(length);
    return taken;
  }

  #start() {
    const args = [join(import.meta.dirname, "foreign.py"), this.#readers];
    const child = spawn(this.#python, args, { stdio: ["pipe", "pipe", "ignore"] });
    child.stdin.on("error", () => undefined);
    child.stdout.on("data", (bytes: Buffer) => {
      this.#bytes = Buffer.concat([this.#bytes, bytes]);
      this.#wake();
    });
    child.on("exit", () => {
      this.#wake();
    });
    return child;
  }
}
