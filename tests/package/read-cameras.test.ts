// The reader of cameras, as users of the package call it. The files are written here.
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { type CameraOfImage, HprError, readCameras } from "hidden-point-removal/files";
import { PerspectiveCamera, Quaternion, Vector3 } from "three";
import { afterAll, describe, expect, it } from "vitest";

import { Random } from "../files/random";
import { readyPackage } from "./support";

const { PointCloud } = await readyPackage();

const scratch = mkdtempSync(join(tmpdir(), "cameras-"));
afterAll(() => {
  rmSync(scratch, { recursive: true });
});

/** COLMAP's models by its numbers, with parameters. */
const MODELS: [string, number[]][] = [
  ["SIMPLE_PINHOLE", [500, 320, 240]],
  ["PINHOLE", [500, 510, 320.5, 240.25]],
  ["SIMPLE_RADIAL", [500, 320, 240, 0.1]],
  ["RADIAL", [500, 320, 240, 0.1, -0.02]],
  ["OPENCV", [500, 510, 320, 240, 0.1, -0.02, 0.001, 0.002]],
  ["OPENCV_FISHEYE", [500, 510, 320, 240, 0.1, -0.02, 0.003, 0.004]],
  ["FULL_OPENCV", [500, 510, 320, 240, 0.1, -0.02, 0.001, 0.002, 0.03, 0.04, 0.05, 0.06]],
  ["FOV", [500, 510, 320, 240, 0.9]],
  ["SIMPLE_RADIAL_FISHEYE", [500, 320, 240, 0.1]],
  ["RADIAL_FISHEYE", [500, 320, 240, 0.1, -0.02]],
  ["THIN_PRISM_FISHEYE", [500, 510, 320, 240, 0.1, -0.02, 0.001, 0.002, 0.03, 0.04, 0.05, 0.06]],
];
const IMAGES = MODELS.map((_, i) => {
  const turn = new Quaternion().setFromAxisAngle(new Vector3(1, i, -2).normalize(), 0.3 * i + 0.1);
  return { turn, move: [i, 2 - i, 4.5], camera: i + 1, name: `left/photo ${i}.jpg`, points: i % 3 };
});

const CAMERAS_TXT = [
  "# Camera list with one line of data per camera:",
  ...MODELS.map(([model, parameters], i) => [i + 1, model, 640, 480, ...parameters].join(" ")),
].join("\n");
const IMAGES_TXT = [
  "# Image list with two lines of data per image:",
  ...IMAGES.flatMap(({ turn: { x, y, z, w }, move, camera, name, points }, i) => [
    [i + 7, w, x, y, z, ...move, camera, name].join(" "),
    Array.from({ length: points }, (_, k) => `1.5 ${k}.25 -1`).join(" "),
  ]),
  "",
].join("\r\n");

/** Numbers one after another, little-endian. */
function packed(...parts: (["u32" | "u64" | "f64", ...number[]] | string)[]): Uint8Array<ArrayBuffer> {
  return new Uint8Array(
    Buffer.concat(
      parts.map((part) => {
        if (typeof part === "string") return Buffer.from(`${part}\0`);
        const [type, ...numbers] = part;
        const bytes = new DataView(new ArrayBuffer(numbers.length * (type === "u32" ? 4 : 8)));
        numbers.forEach((number, i) => {
          if (type === "u32") bytes.setUint32(4 * i, number, true);
          else if (type === "u64") bytes.setBigUint64(8 * i, BigInt(number), true);
          else bytes.setFloat64(8 * i, number, true);
        });
        return Buffer.from(bytes.buffer);
      }),
    ),
  );
}

const CAMERAS_BIN = packed(
  ["u64", MODELS.length],
  ...MODELS.flatMap(([, parameters], i): Parameters<typeof packed> => [
    ["u32", i + 1, i],
    ["u64", 640, 480],
    ["f64", ...parameters],
  ]),
);
const IMAGES_BIN = packed(
  ["u64", IMAGES.length],
  ...IMAGES.flatMap(({ turn: { x, y, z, w }, move, camera, name, points }, i): Parameters<typeof packed> => [
    ["u32", i + 7],
    ["f64", w, x, y, z, ...move],
    ["u32", camera],
    name,
    ["u64", points],
    ...Array.from({ length: points }, (_, k): ["f64", ...number[]] => ["f64", 1.5, k, NaN]),
  ]),
);

type Content = Uint8Array<ArrayBuffer> | string;
const file = (name: string, content: Content) => new File([content], name);
const pair = (cameras: Content, images: Content, ending: string) => [
  file(`cameras.${ending}`, cameras),
  file(`images.${ending}`, images),
];

/** A folder with these files. */
function folder(name: string, files: Record<string, Content>): string {
  const path = mkdtempSync(join(scratch, name));
  for (const [name, content] of Object.entries(files)) writeFileSync(join(path, name), content);
  return path;
}

const refused = (source: unknown, options?: object) =>
  readCameras(source as never, options).then(
    () => "read",
    (error: unknown) => (error instanceof HprError ? `${error.code}: ${error.message}` : String(error)),
  );

/** Where a camera shows a point. */
function pixel({ camera }: CameraOfImage, point: [number, number, number]): number[] {
  const cloud = new PointCloud(point);
  const { pixels } = cloud.visibleFromCamera(camera);
  cloud.dispose();
  return [...pixels];
}

describe("COLMAP", () => {
  it("text and binary give the same cameras, in the order of the images", async () => {
    const text = await readCameras(pair(CAMERAS_TXT, IMAGES_TXT, "txt"));
    expect(text.map(({ image }) => image)).toEqual(IMAGES.map(({ name }) => name));
    text.forEach(({ camera }, i) => {
      const [model, parameters] = MODELS[i]!;
      const one = [0, 2, 3, 8, 9].includes(i);
      const [fx, fy, cx, cy, ...distortion] = one ? [parameters[0], ...parameters] : parameters;
      expect(camera).toMatchObject({ model, fx, fy, cx, cy, distortion, width: 640, height: 480 });
      const { turn, move } = IMAGES[i]!;
      const point = new Vector3(0.3, -0.2, 5).applyQuaternion(turn).add(new Vector3(...move));
      const m = Array.from(camera.worldToCamera!);
      [point.x, point.y, point.z].forEach((x, axis) => {
        expect(m[axis]! * 0.3 - m[axis + 4]! * 0.2 + m[axis + 8]! * 5 + m[axis + 12]!).toBeCloseTo(x, 12);
      });
    });
    expect(await readCameras(pair(CAMERAS_BIN, IMAGES_BIN, "bin"))).toEqual(text);
    const files = { "cameras.txt": CAMERAS_TXT, "images.txt": IMAGES_TXT };
    const path = folder("text", files);
    for (const source of [path, pathToFileURL(path), ["images.txt", "cameras.txt"].map((name) => join(path, name))]) {
      expect(await readCameras(source)).toEqual(text);
    }
    // A folder may hold other files, and then the binary ones count.
    const both = folder("both", {
      ...files,
      "cameras.txt": "",
      "cameras.bin": CAMERAS_BIN,
      "images.bin": IMAGES_BIN,
      "points3D.bin": "",
    });
    expect(await readCameras(both)).toEqual(text);
    for (const { camera } of text) expect(() => pixel({ camera, image: "" }, [0, 0, 9])).not.toThrow();
  });

  it("files that are wrong are refused, with the line or the byte, and the field", async () => {
    const [camera, image] = ["1 PINHOLE 640 480 500 500 320 240", "1 1 0 0 0 0 0 0 1 a.jpg"];
    const bad: [Content, Content, RegExp][] = [
      [`${camera} 5`, image, /^load: cameras.txt cannot be read: line 1 has 5 PARAMS, and PINHOLE has 4/],
      [camera.replace("PINHOLE", "DIVISION"), image, /line 1 has a MODEL that is not read: "1 DIVISION/],
      [camera.replace("PINHOLE", "constructor"), image, /line 1 has a MODEL that is not read/],
      [`${camera}\n${camera}`, image, /line 2 has a CAMERA_ID a second time/],
      [camera.replace("320", "x"), image, /line 1 has no finite number for PARAMS/],
      [camera.replace("320", "1e400"), image, /line 1 has no finite number for PARAMS/],
      [camera.replace("500", "-5"), image, /line 1 has -5 for fx/],
      [camera.replace("640", "0"), image, /line 1 has 0 for width/],
      [camera.replace("1", "one"), image, /line 1 has no number for CAMERA_ID/],
      [camera, image.replace("1 a", "2 a"), /images.txt cannot be read: line 1 has a CAMERA_ID that/],
      [camera, image.replace("1 1 0", "1 0 0"), /line 1 has a pose that is not finite, or a quaternion of zeros/],
      [camera, "1 1 0 0 0 0 0 0 1", /line 1 is not IMAGE_ID/],
      // Without the lines of points, every other image would be lost.
      [camera, `${image}\n${image}`, /line 2 does not hold POINTS2D/],
      [camera, "\0\x01", /images.txt cannot be read: it is not text/],
    ];
    for (const [cameras, images, message] of bad) expect(await refused(pair(cameras, images, "txt"))).toMatch(message);
    for (const length of [0, 7, 30, 80, CAMERAS_BIN.length - 1]) {
      expect(await refused(pair(CAMERAS_BIN.slice(0, length), IMAGES_BIN, "bin"))).toMatch(
        /^load: cameras.bin .*byte \d+/,
      );
    }
    for (const length of [0, 7, 30, 80, 100, IMAGES_BIN.length - 1]) {
      expect(await refused(pair(CAMERAS_BIN, IMAGES_BIN.slice(0, length), "bin"))).toMatch(
        /^load: images.bin .*byte \d+/,
      );
    }
    const longer = new Uint8Array([...IMAGES_BIN, 0]);
    expect(await refused(pair(CAMERAS_BIN, longer, "bin"))).toMatch(`it goes on at byte ${IMAGES_BIN.length}`);
    const other = CAMERAS_BIN.slice();
    other[12] = 11;
    expect(await refused(pair(other, IMAGES_BIN, "bin"))).toMatch(/camera 1 of 11, at byte 8, has the MODEL_ID 11/);
    for (const lone of [file("images.txt", IMAGES_TXT), file("cameras.bin", CAMERAS_BIN), new Blob([CAMERAS_TXT])]) {
      expect(await refused(lone)).toMatch(/^load: .*give both, or their folder/);
    }
  });
});

describe("nerfstudio", () => {
  const three = new PerspectiveCamera();
  three.position.set(1, 2, 3);
  three.lookAt(0, 0.5, -1);
  three.updateMatrixWorld();
  const e = three.matrixWorld.elements;
  const transform_matrix = [0, 1, 2, 3].map((row) => [0, 1, 2, 3].map((column) => e[4 * column + row]!));
  const frame = { file_path: "images/a.png", transform_matrix };
  const whole = { w: 640, h: 480, fl_x: 500, fl_y: 510, cx: 320.5, cy: 239, frames: [frame] };
  const read = (json: object) => readCameras(new Blob([JSON.stringify(json)]));

  it("a rotation of four digits becomes the nearest one; a matrix that is none stays, and is refused when it is used", async () => {
    const rounded = transform_matrix.map((row) => row.map((x, i) => (i < 3 ? Number(x.toFixed(4)) : x)));
    const [{ camera }] = (await read({ ...whole, frames: [{ ...frame, transform_matrix: rounded }] })) as [
      CameraOfImage,
    ];
    const m = Array.from(camera.cameraToWorld!);
    for (const a of [0, 1, 2]) {
      for (const b of [0, 1, 2]) {
        const dot = [0, 1, 2].reduce((sum, i) => sum + m[4 * a + i]! * m[4 * b + i]!, 0);
        expect(dot).toBeCloseTo(a === b ? 1 : 0, 6);
      }
    }
    m.forEach((x, i) => expect(x).toBeCloseTo(e[i]!, 3));
    const skewed = transform_matrix.map((row) => row.map((x, i) => (i === 0 ? x * 1.01 : x)));
    const [kept] = (await read({ ...whole, frames: [{ ...frame, transform_matrix: skewed }] })) as [CameraOfImage];
    const cloud = new PointCloud([0, 0, 0]);
    expect(() => cloud.visibleFromCamera(kept.camera)).toThrow(/rotation and a translation, to within 1e-5/);
  });

  it("numbers of the file and of its frames", async () => {
    const [{ camera, image }] = (await read(whole)) as [CameraOfImage];
    expect(image).toBe("images/a.png");
    expect(camera).toMatchObject({
      fx: 500,
      fy: 510,
      cx: 320.5,
      cy: 239,
      width: 640,
      height: 480,
      convention: "opengl",
    });
    expect(Array.from(camera.cameraToWorld!)).toEqual(e);
    // Two units ahead, half a unit to the right and a quarter up.
    const at = new Vector3(0.5, 0.25, -2).applyMatrix4(three.matrixWorld);
    const [u, v] = pixel({ camera, image }, [at.x, at.y, at.z]);
    expect(u).toBeCloseTo(500 * 0.25 + 320.5, 3);
    expect(v).toBeCloseTo(-510 * 0.125 + 239, 3);
    const more = { k1: 0.1, k2: 0.2, k3: 0.3, p1: 0.01, p2: 0.02 };
    const frames = [frame, { ...frame, file_path: "b", fl_x: 400, w: 320, k1: 0.5 }];
    const [one, other] = (await read({ ...whole, ...more, frames })) as [CameraOfImage, CameraOfImage];
    expect(one.camera).toMatchObject({ model: "OPENCV", distortion: [0.1, 0.2, 0.01, 0.02, 0.3] });
    expect(other.camera).toMatchObject({ fx: 400, width: 320, distortion: [0.5, 0.2, 0.01, 0.02, 0.3] });
    const fisheye = await read({ ...whole, ...more, k4: 0.4, camera_model: "OPENCV_FISHEYE" });
    expect(fisheye[0]!.camera).toMatchObject({ model: "OPENCV_FISHEYE", distortion: [0.1, 0.2, 0.3, 0.4] });
    const blender = await read({ w: 800, h: 600, camera_angle_x: Math.PI / 2, frames: [frame] });
    expect(blender[0]!.camera).toMatchObject({ cx: 400, cy: 300 });
    expect([blender[0]!.camera.fx, blender[0]!.camera.fy]).toEqual([expect.closeTo(400, 9), expect.closeTo(400, 9)]);
  });

  it("cameras.json of Gaussian splats", async () => {
    const rotation = [[0, 0, 1], [1, 0, 0], [0, 1, 0]]; // prettier-ignore
    const splat = { id: 0, img_name: "a", width: 640, height: 480, position: [1, 2, 3], rotation, fy: 510, fx: 500 };
    const [one] = (await read([splat])) as [CameraOfImage];
    expect(one.image).toBe("a");
    // Two units ahead, half a unit to the right and a quarter down, in the world's axes.
    const [u, v] = pixel(one, [1 + 2, 2 + 0.5, 3 + 0.25]);
    expect(u).toBeCloseTo(500 * 0.25 + 320, 3);
    expect(v).toBeCloseTo(510 * 0.125 + 240, 3);
    await expect(read([{ ...splat, rotation: [1, 2] }])).rejects.toThrow(/camera \[0\].*cameraToWorld/);
  });

  it("fields that are wrong are refused", async () => {
    const bad: [unknown, RegExp][] = [
      [{ ...whole, frames: undefined }, /frames must be an array/],
      [{ ...whole, w: undefined }, /frames\[0\].w must be given, or width and height \(--size WxH\), got undefined/],
      [{ ...whole, fl_x: "500" }, /frames\[0\].fl_x must be a finite number, got "500"/],
      [{ ...whole, fl_x: undefined }, /frames\[0\].fl_x must be/],
      [{ ...whole, fl_x: 0 }, /frames\[0\] has 0 for fx/],
      [{ ...whole, camera_model: "EQUIRECTANGULAR" }, /frames\[0\].camera_model must be one of/],
      [{ ...whole, k4: 1 }, /frames\[0\].k4 must be 0/],
      [{ ...whole, frames: [frame, 5] }, /frames\[1\] must be an object/],
      [{ ...whole, frames: [{ ...frame, file_path: 5 }] }, /file_path must be a text/],
      [{ ...whole, frames: [{ ...frame, transform_matrix: [[1, 0, 0, 0]] }] }, /transform_matrix must be 4 rows/],
      [{ ...whole, frames: [{ ...frame, transform_matrix: [[], [], [], []] }] }, /transform_matrix must be 4 rows/],
    ];
    for (const [json, message] of bad) expect(await refused(new Blob([JSON.stringify(json)]))).toMatch(message);
    expect(await refused(file("transforms.json", "{ frames"))).toMatch(
      /^load: transforms.json cannot be read: it is not JSON/,
    );
  });
});

describe("KITTI and OpenCV, whose first pixel has its center at 0", () => {
  // Of the lidar's x forward, y left, z up, the camera's are -y, -z, x.
  const kitti = [
    "P0: 700 0 600 0 0 710 180 0 0 0 1 0",
    "P2: 700 0 600 35 0 710 180 -7.1 0 0 1 0.002",
    "R0_rect: 1 0 0 0 1 0 0 0 1",
    "Tr_velo_to_cam: 0 -1 0 0.1 0 0 -1 0.2 1 0 0 -0.3",
    "Tr_imu_to_velo: 1 0 0",
  ];
  const yaml = [
    "%YAML:1.0",
    "---",
    'calibration_time: "today"',
    "image_width: 640",
    "image_height: 480",
    "camera_matrix: !!opencv-matrix",
    "   rows: 3",
    "   cols: 3",
    "   dt: d",
    "   data: [ 5.0e+02, 0., 3.195e+02, 0., 510., 239.5,",
    "       0., 0., 1. ]",
    "distortion_coefficients: !!opencv-matrix",
    "   rows: 5",
    "   cols: 1",
    "   dt: d",
    "   data: [ 0.1, -0.2, 0.001, 0.002, 0.05 ]",
    "avg_reprojection_error: 0.5",
  ];

  it("KITTI's calibration", async () => {
    const found = await readCameras(file("calib.txt", kitti.join("\n")));
    expect(found.map(({ image }) => image)).toEqual(["image_0", "image_2"]);
    const [x, y, z] = [-3 + 0.1, -1 + 0.2, 10 - 0.3];
    for (const [camera, p] of [
      [found[0]!, [0, 0, 0]],
      [found[1]!, [35, -7.1, 0.002]],
    ] as const) {
      expect(camera.camera).toMatchObject({ fx: 700, fy: 710, cx: 600.5, cy: 180.5, width: 1242, height: 375 });
      // The formula of KITTI: P · R · Tr · x, and half a pixel.
      const [u, v] = pixel(camera, [10, 3, 1]);
      expect(u).toBeCloseTo((700 * x + 600 * z + p[0]) / (z + p[2]) + 0.5, 3);
      expect(v).toBeCloseTo((710 * y + 180 * z + p[1]) / (z + p[2]) + 0.5, 3);
    }
    const odometry = await readCameras(
      new Blob([
        kitti
          .join("\n")
          .replace("Tr_velo_to_cam", "Tr")
          .replace(/R0.*\n/, ""),
      ]),
    );
    expect(odometry).toEqual(found);
    // The raw data: the same numbers in two files, with the sizes of images.
    const two = [
      file(
        "calib_cam_to_cam.txt",
        `calib_time: 09-Jan-2012 13:57:47\ncorner_dist: 9.95e-02\nR_00: 1 2\nS_rect_02: 1241 376\n${kitti
          .slice(0, 3)
          .join("\n")
          .replace("R0_rect", "R_rect_00")
          .replaceAll(/^P/gm, "P_rect_0")}`,
      ),
      file("calib_velo_to_cam.txt", "calib_time: 15-Mar-2012\nR: 0 -1 0 0 0 -1 1 0 0\nT: 0.1 0.2 -0.3\ndelta_f: 0 0"),
    ];
    const raw = await readCameras(two);
    expect(raw[0]).toEqual(found[0]);
    expect(raw[1]).toEqual({ ...found[1], camera: { ...found[1]!.camera, width: 1241, height: 376 } });
    for (const one of two) expect(await refused(one)).toMatch(/KITTI's raw calibration is two files: give/);
    const sized = await readCameras(new Blob([kitti.join("\n")]), { width: 1224, height: 370 });
    expect(sized[0]!.camera).toMatchObject({ width: 1224, height: 370 });
    for (const [from, to, message] of [
      [" 0.002", "", /^load: calib.txt cannot be read: line 2 has 11 numbers for P2, which has 12/],
      ["-0.3", "x", /line 4 has no finite number for Tr_velo_to_cam/],
      ["P0: 700", "P0: 0", /line 1 has 0 for fx/],
      ["P2", "P0", /line 2 has P0 a second time/],
    ] as const) {
      expect(await refused(file("calib.txt", kitti.join("\n").replace(from, to)))).toMatch(message);
    }
    expect(await refused(new Blob(kitti), { width: 5 })).toMatch(/^option: height must be/);
  });

  it("the YAML of OpenCV and of ROS", async () => {
    const [{ camera, image }] = (await readCameras(file("camera.yml", yaml.join("\n")))) as [CameraOfImage];
    expect([camera.fx, camera.fy, camera.cx, camera.cy, camera.width, camera.height]).toEqual([
      500, 510, 320, 240, 640, 480,
    ]);
    expect([camera.model, camera.distortion, image]).toEqual(["OPENCV", [0.1, -0.2, 0.001, 0.002, 0.05], ""]);
    expect(pixel({ camera, image }, [0, 0, 4])).toEqual([320, 240]);
    const ros = yaml.slice(2).map((line) => line.replace(" !!opencv-matrix", "").replace(/ +dt.*/, ""));
    expect((await readCameras(new Blob([ros.join("\r\n")])))[0]).toEqual({ camera, image });
    const fisheye = [
      ...ros.slice(0, 9),
      "distortion_model: equidistant",
      "distortion_coefficients: { rows: 1, cols: 4, data: [1, 2, 3, 4] }",
    ];
    expect((await readCameras(new Blob([fisheye.join("\n")])))[0]!.camera).toMatchObject({
      model: "OPENCV_FISHEYE",
      distortion: [1, 2, 3, 4],
    });
    const all = yaml.join("\n");
    for (const [from, to, message] of [
      ["camera_matrix", "matrix", /it is none of the files|it has no camera_matrix/],
      ["image_width: 640", "", /it has no image_width and image_height; give width and height/],
      ["500", "0", /.*/],
      ["5.0e+02, 0.", "5.0e+02, 1.", /line 6 has 1 for the skew/],
      ["5.0e+02", ".Nan", /line 6 has no finite number for camera_matrix/],
      ["0., 0., 1. ]", "0., 1. ]", /line 6 has 8 numbers for camera_matrix/],
      ["rows: 5", "rows: 6", /line 12 has 5 numbers for distortion_coefficients/],
      ["data: [ 0.1", "data: ( 0.1", /line 12 has no list for distortion_coefficients/],
      ["avg_reprojection_error", "image_width", /line 17 has image_width a second time/],
    ] as const) {
      expect(await refused(file("camera.yml", all.replace(from, to)))).toMatch(message);
    }
    const sized = await readCameras(new Blob([all.replace("image_width: 640", "")]), { width: 9, height: 9 });
    expect(sized[0]!.camera).toMatchObject({ width: 9, height: 480 });
    const prism = all.replace("rows: 5", "rows: 12").replace("0.05 ]", "0.05, 0, 0, 0, 0, 0, 0, 1 ]");
    expect(await refused(new Blob([prism]))).toMatch(/line 12 has distortion_coefficients of a thin prism/);
  });

  it("damaged bytes give cameras or an HprError, never anything else", async () => {
    const random = new Random(7);
    const json = JSON.stringify({ w: 4, h: 3, fl_x: 5, frames: [{ file_path: "a", transform_matrix: [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]] }] }); // prettier-ignore
    const good: Content[][] = [
      [CAMERAS_TXT, IMAGES_TXT],
      [CAMERAS_BIN, IMAGES_BIN],
      [json],
      [kitti.join("\n")],
      [yaml.join("\n")],
    ];
    const seen = { read: 0, load: 0 };
    for (let round = 0; round < 3000; round++) {
      const parts = good[round % good.length]!.map((part) => new Uint8Array(Buffer.from(part)));
      const bytes = parts[random.below(parts.length)]!;
      for (let i = 0; i <= random.below(3); i++) bytes[random.below(bytes.length)] = random.below(256);
      const damaged = random.below(4) === 0 ? bytes.slice(0, random.below(bytes.length)) : bytes;
      const all = parts.map((part) => (part === bytes ? damaged : part));
      const ending = round % good.length === 1 ? "bin" : "txt";
      const source = all.length === 2 ? pair(all[0]!, all[1]!, ending) : file("calib.txt", all[0]!);
      const outcome = await refused(source);
      expect(outcome).toMatch(/^(read$|load: (calib|cameras|images)\.(txt|bin) cannot be read: )/);
      expect(outcome).not.toMatch(/it is broken/);
      seen[outcome === "read" ? "read" : "load"] += 1;
    }
    expect(Math.min(seen.read, seen.load)).toBeGreaterThan(300);
  });
});

it("sources that are none are refused", async () => {
  for (const source of [undefined, null, 7, {}, [], [null], [7, 8], [new Blob([]), new Blob([])]]) {
    expect(await refused(source)).toMatch(/^option: /);
  }
  expect(await refused(join(scratch, "nothing"))).toMatch(/^load: /);
  expect(await refused(folder("empty", {}))).toMatch(/^load: .* must hold cameras and images/);
  expect(await refused(new Blob(["1 2 3"]))).toMatch(
    /^load: the file cannot be read: it is none of the files of cameras/,
  );
  expect(await refused(new Blob(["{}"]), { size: 5 })).toMatch(/^option: unknown option "size"/);
  expect(await refused(new Blob(["{}"]), { width: 0, height: 4 })).toMatch(/^option: width must be/);
});
