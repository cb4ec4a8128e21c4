// deck.gl's views and coordinate systems: the place of the camera among the positions of the cloud.
import { FirstPersonView, _GlobeView as GlobeView, MapView, OrbitView } from "@deck.gl/core";
import type { Viewport } from "@deck.gl/core";
import { expect, it } from "vitest";

import { Frame } from "../../src/ts/deck/frame.js";

const SIZE = { width: 400, height: 300 };
const HOME = [11.57, 48.14] as const;
const [METER_OFFSETS, LNGLAT, LNGLAT_OFFSETS, CARTESIAN] = ["meter-offsets", "lnglat", "lnglat-offsets", "cartesian"];

const viewport = (view: { makeViewport(options: never): unknown }, viewState: object) =>
  view.makeViewport({ ...SIZE, viewState } as never) as Viewport;
const [longitude, latitude] = HOME;
const map = viewport(new MapView({}), { longitude, latitude, zoom: 17, pitch: 60, bearing: 30 });
const street = viewport(new FirstPersonView({}), {
  longitude,
  latitude,
  position: [30, -200, 12],
  bearing: 0,
  pitch: 0,
});
const local = viewport(new FirstPersonView({}), { position: [1, 2, 3], bearing: 0, pitch: 0 });

const near = (got: readonly number[], expected: readonly number[], tolerance: number) => {
  expect(Math.hypot(...got.map((x, axis) => x - expected[axis]!))).toBeLessThan(tolerance);
};

it("METER_OFFSETS: the camera's own offset in meters", () => {
  const frame = new Frame(street, { coordinateSystem: METER_OFFSETS, coordinateOrigin: HOME });
  expect(frame.seen(street).isDirection).toBe(false);
  near(frame.seen(street).from, [30, -200, 12], 0.01);
  const higher = new Frame(street, { coordinateSystem: METER_OFFSETS, coordinateOrigin: [...HOME, 5] });
  near(higher.seen(street).from, [30, -200, 7], 0.01);
});

it("modelMatrix: the camera in the data's coordinates", () => {
  // Turns by 90° around z, scales by 500 and moves.
  const modelMatrix = [0, 500, 0, 0, -500, 0, 0, 0, 0, 0, 500, 0, 10, 20, 30, 1];
  const seen = (view: Viewport, props: object) => new Frame(view, { modelMatrix, ...props }).seen(view).from;
  near(seen(street, { coordinateSystem: METER_OFFSETS, coordinateOrigin: HOME }), [-0.44, -0.04, -0.036], 1e-4);
  near(seen(local, {}), [-18 / 500, 9 / 500, -27 / 500], 1e-9);
  const orbit = viewport(new OrbitView({ orthographic: true }), { target: [0, 0, 0], rotationX: 90, zoom: 1 });
  const direction = new Frame(orbit, { modelMatrix }).seen(orbit);
  expect(direction.isDirection).toBe(true);
  const length = Math.hypot(...direction.from);
  near(
    direction.from.map((x) => x / length),
    [0, 0, -1],
    1e-9,
  );
  const uneven = { modelMatrix: [1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] };
  expect(() => new Frame(local, uneven).seen(local)).toThrow(/modelMatrix scales the axes differently/);
  expect(new Frame(local, uneven).given([1, 2, 3]).from).toEqual([1, 2, 3]);
});

it.each([
  ["a map", map],
  ["a first-person view", street],
])("degrees in %s: distances to the camera and among the points, in meters, as drawn", (_, view) => {
  const at = (east: number, north: number, up: number) => [
    longitude + east / (111_194.9 * Math.cos((latitude * Math.PI) / 180)),
    latitude + north / 111_194.9,
    up,
  ];
  const points = Float64Array.from([at(-50, -50, 0), at(50, -50, 0), at(50, 50, 20), at(-50, 50, 0)].flat());
  const frame = new Frame(view, { coordinateSystem: LNGLAT });
  const taken = frame.take(points);
  [
    [-50, -50, 0],
    [50, -50, 0],
    [50, 50, 20],
    [-50, 50, 0],
  ].forEach((expected, i) => {
    near([...taken.subarray(3 * i, 3 * i + 3)], expected, 0.02);
  });
  // deck.gl's own projection: one unit of its space, in meters.
  const eye = frame.seen(view).from;
  const meter = view.distanceScales.metersPerUnit[2]!;
  for (let i = 0; i < 4; i++) {
    const drawn = view.projectPosition([...points.subarray(3 * i, 3 * i + 3)]);
    const distance = meter * Math.hypot(...drawn.map((x, axis) => x - view.cameraPosition[axis]!));
    const own = Math.hypot(...eye.map((x, axis) => x - taken[3 * i + axis]!));
    expect(Math.abs(own / distance - 1)).toBeLessThan(1e-4);
  }
  // Another camera keeps the cloud, and a viewpoint may be given in degrees.
  const next = new Frame(view, { coordinateSystem: LNGLAT });
  expect(next.key).toBe(frame.key);
  next.goOn(frame);
  near(next.given(at(0, 10, 2)).from, [0, 10, 2], 0.01);
  const offsets = new Frame(view, { coordinateSystem: LNGLAT_OFFSETS, coordinateOrigin: HOME });
  const apart = points.map((x, i) => (i % 3 < 2 ? x - HOME[i % 3]! : x));
  offsets.take(apart).forEach((x, i) => {
    expect(Math.abs(x - taken[i]!)).toBeLessThan(1e-6);
  });
});

it.each([
  ["a first-person view", local, {}],
  ["an orbit", viewport(new OrbitView({}), { target: [1, 2, 3], rotationX: 40, rotationOrbit: 70, zoom: 5 }), {}],
  ["degrees in a map", map, { coordinateSystem: LNGLAT }],
  ["degrees in a first-person view", street, { coordinateSystem: LNGLAT }],
])("%s: the corners of the picture are the edge of the cone", (_, view, props) => {
  const frame = new Frame(view, props);
  frame.take(Float64Array.from([...HOME, 0]));
  const { from, cone } = frame.seen(view);
  for (const corner of [
    [0, 0],
    [SIZE.width, 0],
    [0, SIZE.height],
  ]) {
    const to = frame.given(view.unproject([...corner, 0.5])).from.map((x, axis) => x - from[axis]!);
    const cosine = to.reduce((sum, x, axis) => sum + x * cone!.direction[axis]!, 0) / Math.hypot(...to);
    expect(Math.abs((Math.acos(cosine) * 360) / Math.PI - cone!.angle)).toBeLessThan(0.5);
  }
});

it("knows that a map repeats around the world", () => {
  const east = viewport(new MapView({}), { longitude: 179.9999, latitude: 10, zoom: 18 });
  const frame = new Frame(east, { coordinateSystem: METER_OFFSETS, coordinateOrigin: [-179.9999, 10] });
  expect(Math.abs(frame.seen(east).from[0]!)).toBeLessThan(30);
});

it("refuses what it cannot convert", () => {
  const globe = viewport(new GlobeView({}), { longitude, latitude, zoom: 3 });
  for (const [view, props] of [
    [globe, {}],
    [map, { coordinateSystem: CARTESIAN }],
    [local, { coordinateSystem: LNGLAT }],
    [local, { coordinateSystem: METER_OFFSETS }],
  ] as const) {
    expect(() => new Frame(view, props).seen(view)).toThrow(expect.objectContaining({ code: "option" }));
  }
  expect(() => new Frame(globe, {}).seen(globe)).toThrow(/give viewpoint/);
});
