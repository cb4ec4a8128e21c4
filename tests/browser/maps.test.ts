// Maps of directions on a graphics card: the shaders' text, and the filters that draw by it.
import { beforeAll, describe, expect, it } from "vitest";
import { modulesPage } from "./modules-page.js";

interface Modules {
  three: typeof import("three");
  "hidden-point-removal": typeof import("hidden-point-removal");
  "hidden-point-removal/three": typeof import("hidden-point-removal/three");
  "hidden-point-removal/nodes": typeof import("hidden-point-removal/nodes");
}

const shared = modulesPage({
  three: "/node_modules/three/build/three.module.js",
  "hidden-point-removal": "/dist/index.js",
  "hidden-point-removal/three": "/dist/three.js",
  "hidden-point-removal/nodes": "/dist/nodes.js",
});

beforeAll(async () => {
  await shared.page.evaluate(async () => {
    const { modules } = globalThis as unknown as { modules: Modules };
    await modules["hidden-point-removal"].init();
    /** A bumpy ball somewhere, in single precision. */
    const ball = (count: number, [x, y, z] = [0, 0, 0]) => {
      const positions = new Float32Array(3 * count);
      for (let i = 0; i < count; i++) {
        const up = 1 - (2 * (i + 0.5)) / count;
        const turn = i * Math.PI * (3 - Math.sqrt(5));
        const radius = (2 + 0.2 * Math.sin(7 * turn)) * Math.sqrt(1 - up * up);
        positions.set([x + radius * Math.cos(turn), y + 2 * up, z + radius * Math.sin(turn)], 3 * i);
      }
      return positions;
    };
    Object.assign(globalThis, { ball });
  });
});

declare const ball: (count: number, place?: number[]) => Float32Array<ArrayBuffer>;
declare const modules: Modules;

/** How many more viewpoints are tried, each with 200,000 points. */
const TURNS = Number(process.env["HPR_TURNS"] ?? 0);

/** How many points a card and `hides` call hidden, and on how many they differ. */
interface Compared {
  hidden: number;
  differs: number;
  wrong: number;
}

describe("the shader's text", () => {
  it("tests points as `hides` does, in WebGL", async () => {
    const found = await shared.page.evaluate((turns) => {
      const { PointCloud } = modules["hidden-point-removal"];
      const gl = document.createElement("canvas").getContext("webgl2")!;
      const compared: Compared[] = [];
      const views: [place: number[], viewpoint: number[], exponent?: number | undefined][] = [
        [[0, 0, 0], [5, 3, 4], 3],
        [[0, 0, 0], [2.5, 0, 0], 2],
        [
          [3000, -2000, 100],
          [3005, -1997, 104],
        ],
      ];
      for (let i = 0; i < turns; i++) {
        const [x, y, z] = [Math.sin(i), Math.cos(3 * i), Math.cos(i)].map((x) => (2.2 + (i % 7) ** 2) * x);
        const place = i % 3 === 0 ? [3000, -2000, 100] : [0, 0, 0];
        views.push([place, [place[0]! + x!, place[1]! + y!, place[2]! + z!], [2, 3, undefined][i % 3]]);
      }
      for (const [place, viewpoint, exponent] of views) {
        const positions = ball(200_000, [...place]);
        const cloud = new PointCloud(positions);
        const options = exponent === undefined ? {} : { exponent };
        const visible = cloud.visibleFrom(viewpoint, options).mask();
        cloud.visibilityMap(viewpoint, options);
        const map = cloud.visibilityMap(viewpoint, options);
        const compile = (type: number, text: string) => {
          const shader = gl.createShader(type)!;
          gl.shaderSource(shader, text);
          gl.compileShader(shader);
          if (gl.getShaderParameter(shader, gl.COMPILE_STATUS) !== true) throw new Error(gl.getShaderInfoLog(shader)!);
          return shader;
        };
        const program = gl.createProgram();
        const main = "in vec3 position; flat out int answer;\nvoid main() { answer = hidden(position) ? 1 : 0; }";
        gl.attachShader(program, compile(gl.VERTEX_SHADER, `#version 300 es\n${map.glsl}${main}`));
        gl.attachShader(program, compile(gl.FRAGMENT_SHADER, "#version 300 es\nvoid main() {}"));
        gl.transformFeedbackVaryings(program, ["answer"], gl.SEPARATE_ATTRIBS);
        gl.linkProgram(program);
        gl.useProgram(program);
        gl.uniform3fv(gl.getUniformLocation(program, "hprViewpoint"), map.uniforms.hprViewpoint);
        gl.uniform4fv(gl.getUniformLocation(program, "hprMargins"), map.uniforms.hprMargins);
        gl.uniform1i(gl.getUniformLocation(program, "hprDepths"), 0);
        gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
        gl.texImage2D(gl.TEXTURE_2D, 0, gl.R32F, 256, map.data.length / 256, 0, gl.RED, gl.FLOAT, map.data);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
        gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
        gl.bufferData(gl.ARRAY_BUFFER, positions, gl.STATIC_DRAW);
        const at = gl.getAttribLocation(program, "position");
        gl.enableVertexAttribArray(at);
        gl.vertexAttribPointer(at, 3, gl.FLOAT, false, 0, 0);
        const out = gl.createBuffer();
        gl.bindBuffer(gl.TRANSFORM_FEEDBACK_BUFFER, out);
        gl.bufferData(gl.TRANSFORM_FEEDBACK_BUFFER, 4 * visible.length, gl.STATIC_READ);
        gl.bindBufferBase(gl.TRANSFORM_FEEDBACK_BUFFER, 0, out);
        gl.enable(gl.RASTERIZER_DISCARD);
        gl.beginTransformFeedback(gl.POINTS);
        gl.drawArrays(gl.POINTS, 0, visible.length);
        gl.endTransformFeedback();
        const answers = new Int32Array(visible.length);
        gl.getBufferSubData(gl.TRANSFORM_FEEDBACK_BUFFER, 0, answers);
        const hides = map.hides(positions);
        const one = { hidden: 0, differs: 0, wrong: 0 };
        answers.forEach((answer, i) => {
          one.hidden += answer;
          one.differs += Number(answer !== hides[i]);
          one.wrong += Number(answer === 1 && visible[i]! > 0);
        });
        compared.push(one);
        cloud.dispose();
      }
      return compared;
    }, TURNS);
    expect(found.reduce((sum, { hidden }) => sum + hidden, 0)).toBeGreaterThan(60_000 * found.length);
    for (const { differs, wrong } of found) {
      expect(wrong).toBe(0);
      expect(differs).toBeLessThan(20);
    }
  });

  it("tests points as `hides` does, in WebGPU", async (test) => {
    const found = await shared.page.evaluate(async () => {
      // Old browsers have none.
      const gpu = navigator.gpu as GPU | undefined;
      const adapter = await gpu?.requestAdapter();
      if (adapter === null || adapter === undefined) return undefined;
      const device = await adapter.requestDevice();
      const { PointCloud } = modules["hidden-point-removal"];
      const positions = ball(200_000);
      const cloud = new PointCloud(positions);
      const viewpoint = [5, 3, 4];
      const visible = cloud.visibleFrom(viewpoint).mask();
      cloud.visibilityMap(viewpoint);
      const map = cloud.visibilityMap(viewpoint);
      const hides = map.hides(positions);
      const code = `
        @group(0) @binding(0) var hprDepths: texture_2d<f32>;
        struct Numbers { viewpoint: vec4f, margins: vec4f }
        @group(0) @binding(1) var<uniform> numbers: Numbers;
        @group(0) @binding(2) var<storage, read> positions: array<f32>;
        @group(0) @binding(3) var<storage, read_write> answers: array<u32>;
        var<private> hprViewpoint: vec3f;
        var<private> hprMargins: vec4f;
        ${map.wgsl}
        @compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {
          hprViewpoint = numbers.viewpoint.xyz;
          hprMargins = numbers.margins;
          let i = id.x;
          if (i < arrayLength(&answers)) {
            answers[i] = u32(hidden(vec3f(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2])));
          }
        }`;
      const module = device.createShaderModule({ code });
      const { messages } = await module.getCompilationInfo();
      if (messages.length > 0) throw new Error(messages[0]!.message);
      const rows = map.data.length / 256;
      const texture = device.createTexture({ size: [256, rows], format: "r32float", usage: 0x02 | 0x04 });
      device.queue.writeTexture({ texture }, map.data, { bytesPerRow: 1024 }, [256, rows]);
      const buffer = (data: Float32Array<ArrayBuffer> | number, usage: number) => {
        const size = typeof data === "number" ? data : data.byteLength;
        const made = device.createBuffer({ size, usage });
        if (typeof data !== "number") device.queue.writeBuffer(made, 0, data);
        return made;
      };
      const size = 4 * visible.length;
      const answers = buffer(size, 0x80 | 0x04);
      const read = buffer(size, 0x01 | 0x08);
      const pipeline = device.createComputePipeline({
        layout: device.createPipelineLayout({
          bindGroupLayouts: [
            device.createBindGroupLayout({
              entries: [
                { binding: 0, visibility: 4, texture: { sampleType: "unfilterable-float" } },
                { binding: 1, visibility: 4, buffer: {} },
                { binding: 2, visibility: 4, buffer: { type: "read-only-storage" } },
                { binding: 3, visibility: 4, buffer: { type: "storage" } },
              ],
            }),
          ],
        }),
        compute: { module },
      });
      const numbers = Float32Array.of(...map.uniforms.hprViewpoint, 0, ...map.uniforms.hprMargins);
      const group = device.createBindGroup({
        layout: pipeline.getBindGroupLayout(0),
        entries: [
          { binding: 0, resource: texture.createView() },
          { binding: 1, resource: { buffer: buffer(numbers, 0x40 | 0x08) } },
          { binding: 2, resource: { buffer: buffer(positions, 0x80 | 0x08) } },
          { binding: 3, resource: { buffer: answers } },
        ],
      });
      const encoder = device.createCommandEncoder();
      const pass = encoder.beginComputePass();
      pass.setPipeline(pipeline);
      pass.setBindGroup(0, group);
      pass.dispatchWorkgroups(Math.ceil(visible.length / 64));
      pass.end();
      encoder.copyBufferToBuffer(answers, 0, read, 0, size);
      device.queue.submit([encoder.finish()]);
      await read.mapAsync(1);
      const one = { hidden: 0, differs: 0, wrong: 0 };
      new Uint32Array(read.getMappedRange()).forEach((answer, i) => {
        one.hidden += answer;
        one.differs += Number(answer !== hides[i]);
        one.wrong += Number(answer === 1 && visible[i]! > 0);
      });
      cloud.dispose();
      return one;
    });
    if (found === undefined) {
      test.skip("this browser has no WebGPU adapter");
      return;
    }
    expect(found.wrong).toBe(0);
    expect(found.hidden).toBeGreaterThan(60_000);
    expect(found.differs).toBeLessThan(20);
  });
});

describe("a filter", () => {
  it("draws and picks by a map while the camera moves, and leaves everything as it was", async () => {
    const found = await shared.page.evaluate(async () => {
      const THREE = modules.three;
      const { PointCloud } = modules["hidden-point-removal"];
      const { HiddenPointFilter } = modules["hidden-point-removal/three"];
      const { HiddenPointNodesFilter } = modules["hidden-point-removal/nodes"];
      const renderer = new THREE.WebGLRenderer({ preserveDrawingBuffer: true });
      renderer.setSize(300, 300);
      const positions = ball(20_000);
      const bytes = new Uint8Array(3 * 20_000);
      // Each point has its own color, so that the picture tells which points are drawn.
      for (let i = 0; i < 20_000; i++) bytes.set([(i + 1) & 255, ((i + 1) >> 8) & 255, 255], 3 * i);
      const plain = { size: 1, sizeAttenuation: false, vertexColors: true };
      const flat = new THREE.ShaderMaterial({
        vertexShader:
          "varying vec3 c; void main() { c = color; gl_PointSize = 1.0; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }",
        fragmentShader: "varying vec3 c; void main() { gl_FragColor = vec4(c, 1.0); }",
        vertexColors: true,
      });
      const cloud = new PointCloud(positions);
      THREE.ColorManagement.enabled = false;
      renderer.outputColorSpace = THREE.LinearSRGBColorSpace;

      const pixels = () => {
        const gl = renderer.getContext();
        const data = new Uint8Array(4 * 300 * 300);
        gl.readPixels(0, 0, 300, 300, gl.RGBA, gl.UNSIGNED_BYTE, data);
        const drawn = new Set<number>();
        for (let i = 0; i < data.length; i += 4) if (data[i + 2] === 255) drawn.add(data[i]! + 256 * data[i + 1]! - 1);
        return drawn;
      };
      const frame = () => new Promise((resolve) => requestAnimationFrame(resolve));
      const reports = [];
      for (const [name, material] of [
        ["points", new THREE.PointsMaterial(plain)],
        ["shader", flat],
        ["nodes", new THREE.PointsMaterial(plain)],
      ] as const) {
        const make = (first: number, last: number) => {
          const geometry = new THREE.BufferGeometry();
          geometry.setAttribute("position", new THREE.BufferAttribute(positions.slice(3 * first, 3 * last), 3));
          geometry.setAttribute("color", new THREE.BufferAttribute(bytes.slice(3 * first, 3 * last), 3, true));
          return new THREE.Points(geometry, material);
        };
        const group = new THREE.Group();
        if (name === "nodes") {
          for (let k = 0; k < 4; k++) {
            const node = make(5000 * k, 5000 * (k + 1));
            // The node lies elsewhere in its own space.
            node.geometry.translate(0, 0, -k);
            node.position.z = k;
            node.rotation.z = k;
            node.geometry.rotateZ(-k);
            group.add(node);
          }
        } else {
          group.add(make(0, 20_000));
        }
        const scene = new THREE.Scene().add(group);
        // The same material, without a filter.
        const other = make(0, 20_000);
        other.position.x = 100;
        scene.add(other);
        const first = group.children[0] as import("three").Points;
        const camera = new THREE.PerspectiveCamera(40, 1, 0.1, 1000);
        const at = (degrees: number) => {
          const turn = (degrees * Math.PI) / 180;
          camera.position.set(9 * Math.sin(turn), 1, 9 * Math.cos(turn));
          camera.lookAt(0, 0, 0);
          camera.updateMatrixWorld();
        };
        const keys = Object.keys(first);
        const uniforms = Object.keys(flat.uniforms);
        const filter =
          name === "nodes" ? new HiddenPointNodesFilter(group) : new HiddenPointFilter(first, { stale: "map" });
        const kinds: string[] = [];
        let viewpoint: number[] = [];
        filter.addEventListener("change", ({ answer, camera: { position } }) => {
          kinds.push(answer);
          viewpoint = position.toArray();
        });
        at(0);
        while (!filter.settled || filter.answer !== "looks") {
          filter.update(camera);
          renderer.render(scene, camera);
          await frame();
        }
        renderer.render(scene, camera);
        const settled = pixels();
        kinds.length = 0;
        let [maps, wrong, least, mismatched] = [0, 0, 1, 0];
        for (let degrees = 2; degrees <= 40; degrees += 2) {
          const before = maps;
          at(degrees);
          // One map for each place, so that it is known which map is drawn.
          for (let tries = 0; maps === before && tries < 300; tries++) {
            filter.update(camera);
            await frame();
            maps = kinds.filter((kind) => kind === "map").length;
          }
          renderer.render(scene, camera);
          const drawn = pixels();
          const visible = filter.visible;
          const ids =
            visible instanceof Map
              ? group.children.flatMap((node, k) => Array.from(visible.get(node as never)!, (i) => i + 5000 * k))
              : Array.from(visible);
          const listed = new Set(ids);
          for (const id of drawn) if (!listed.has(id)) mismatched++;
          const exact = cloud.visibleFrom(viewpoint, { looks: 3 });
          for (const index of exact.indices) if (!listed.has(index)) wrong++;
          least = Math.min(least, (20_000 - ids.length) / (20_000 - exact.indices.length));
        }
        // What a ray meets is drawn.
        const raycaster = new THREE.Raycaster();
        raycaster.params.Points.threshold = 0.05;
        raycaster.setFromCamera(new THREE.Vector2(0.1, 0.1), camera);
        const picked = raycaster.intersectObject(group);
        const shown = filter.visible;
        const unseen = picked.filter(({ object, index }) => {
          const indices = shown instanceof Map ? shown.get(object as never)! : shown;
          return !Array.from(indices).includes(index!);
        });
        const moving = [...kinds];
        while (!(filter.settled as boolean)) {
          filter.update(camera);
          await frame();
        }
        filter.dispose();
        renderer.render(scene, camera);
        const all = pixels();
        reports.push({
          name,
          settled: settled.size,
          maps,
          moving: [...new Set(moving)],
          last: kinds.at(-1),
          wrong,
          least,
          mismatched,
          unseen: unseen.length,
          picked: picked.length,
          all: all.size,
          left: Object.keys(first).filter((key) => !keys.includes(key)),
          uniforms: Object.keys(flat.uniforms).length - uniforms.length,
          isOwn: Object.prototype.hasOwnProperty.call(material, "onBeforeCompile"),
          key: material.customProgramCacheKey(),
        });
      }
      cloud.dispose();
      return reports;
    });
    console.table(
      found.map(({ name, wrong, least, settled, all, mismatched }) => ({
        name,
        wrong,
        least,
        settled,
        all,
        mismatched,
      })),
    );
    for (const one of found) {
      // A frame may take so long that the camera rests in between.
      expect(one.moving).toContain("map");
      expect(one).toMatchObject({ last: "looks", maps: 20, left: [], uniforms: 0, isOwn: false });
      expect(one.key).not.toContain("hpr");
      expect(one.all).toBeGreaterThan(1.8 * one.settled);
      // Of 8,000 points that three looks show, at most one in a hundred is left out in a frame.
      expect(one.wrong).toBeLessThan(20 * 80);
      expect(one.least).toBeGreaterThan(0.6);
      // The card tests nodes that are turned with a wider margin.
      expect(one.mismatched).toBeLessThan(one.name === "nodes" ? 2000 : 20);
      expect(one.picked).toBeGreaterThan(0);
      expect(one.unseen).toBe(0);
    }
  });

  it("goes on with materials that others patch, dims, and says where none can be drawn", async () => {
    const found = await shared.page.evaluate(async () => {
      const THREE = modules.three;
      const { HiddenPointFilter } = modules["hidden-point-removal/three"];
      const renderer = new THREE.WebGLRenderer({ preserveDrawingBuffer: true });
      renderer.setSize(300, 300);
      const positions = ball(20_000);
      const frame = () => new Promise((resolve) => requestAnimationFrame(resolve));
      const count = () => {
        const gl = renderer.getContext();
        const data = new Uint8Array(4 * 300 * 300);
        gl.readPixels(0, 0, 300, 300, gl.RGBA, gl.UNSIGNED_BYTE, data);
        const seen = { bright: 0, faint: 0, green: 0 };
        for (let i = 0; i < data.length; i += 4) {
          if (data[i]! > 200) seen.bright++;
          else if (data[i]! > 10) seen.faint++;
          if (data[i + 1]! > 200 && data[i]! < 10) seen.green++;
        }
        return seen;
      };
      const flat = { size: 1, sizeAttenuation: false };
      const patched = new THREE.PointsMaterial(flat);
      patched.onBeforeCompile = (shader) => {
        shader.fragmentShader = shader.fragmentShader.replace(
          "#include <opaque_fragment>",
          "gl_FragColor = vec4(0, 1, 0, 1);",
        );
      };
      // oxlint-disable-next-line typescript/unbound-method -- only compared
      const given = patched.onBeforeCompile;
      const late = new THREE.PointsMaterial(flat);
      const raw = new THREE.RawShaderMaterial({
        vertexShader:
          "attribute vec3 position; uniform mat4 projectionMatrix, modelViewMatrix; void main() { gl_PointSize = 1.0; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }",
        fragmentShader: "void main() { gl_FragColor = vec4(1.0); }",
      });
      type Material = InstanceType<typeof THREE.Material>;
      const run = async (material: Material | Material[], options: object, midway?: () => void) => {
        const geometry = new THREE.BufferGeometry();
        geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
        const points = new THREE.Points(geometry, material);
        const scene = new THREE.Scene().add(points);
        const camera = new THREE.PerspectiveCamera(40, 1, 0.1, 1000);
        const filter = new HiddenPointFilter(points, options);
        const kinds = new Set<string>();
        filter.addEventListener("change", ({ answer }) => kinds.add(answer));
        const go = async (degrees: number, until: () => boolean) => {
          const turn = (degrees * Math.PI) / 180;
          camera.position.set(9 * Math.sin(turn), 1, 9 * Math.cos(turn));
          camera.lookAt(0, 0, 0);
          for (let i = 0; i < 300 && !(i > 0 && until()); i++) {
            filter.update(camera);
            renderer.render(scene, camera);
            await frame();
          }
          renderer.render(scene, camera);
        };
        await go(0, () => filter.settled);
        const rest = count();
        midway?.();
        kinds.clear();
        await go(2, () => kinds.size > 0);
        // The answer is that of the place where the camera is. Where a frame takes long, looks have come already.
        await go(4, () => filter.answer !== "looks" || filter.settled);
        const moving = count();
        const seen = [...kinds];
        filter.dispose();
        renderer.render(scene, camera);
        return { rest, moving, seen, all: count() };
      };
      const results = {
        patched: await run(patched, {}),
        late: await run(late, {}, () => {
          const before = late.onBeforeCompile.bind(late);
          late.onBeforeCompile = (shader, by) => {
            before(shader, by);
            shader.fragmentShader = shader.fragmentShader.replace(
              "#include <opaque_fragment>",
              "gl_FragColor = vec4(0, 1, 0, 1);",
            );
          };
          late.customProgramCacheKey = () => "green";
          late.needsUpdate = true;
        }),
        dim: await run(new THREE.PointsMaterial(flat), { mode: "dim" }),
        raw: await run(raw, {}),
        several: await run([new THREE.PointsMaterial(flat)], {}),
        keep: await run(new THREE.PointsMaterial(flat), { stale: "keep" }),
      };
      return { ...results, isGiven: patched.onBeforeCompile === given };
    });
    const { patched, late, dim, raw, several, keep, isGiven } = found;
    expect(isGiven).toBe(true);
    for (const { moving, all } of [patched, late]) {
      expect(moving.green).toBeGreaterThan(4000);
      expect(all.green).toBeGreaterThan(1.7 * moving.green);
    }
    expect(Math.abs(dim.moving.bright - dim.rest.bright)).toBeLessThan(0.3 * dim.rest.bright);
    expect(dim.moving.faint).toBeGreaterThan(0.6 * dim.rest.faint);
    // A raw material without a version has the first one of the language.
    expect(raw.all.bright).toBeGreaterThan(1.7 * raw.moving.bright);
    // Where the machine is slow, looks come in between.
    for (const { seen } of [patched, late, dim, raw]) expect(seen).toContain("map");
    for (const { seen } of [several, keep]) expect(seen).not.toContain("map");
    expect(shared.said.filter((text) => text.includes("the last answer stays"))).toHaveLength(1);
  });

  it("draws by the map again when a lost context has come back", async () => {
    const found = await shared.page.evaluate(async () => {
      const THREE = modules.three;
      const { HiddenPointFilter } = modules["hidden-point-removal/three"];
      const renderer = new THREE.WebGLRenderer({ preserveDrawingBuffer: true });
      renderer.setSize(300, 300);
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.BufferAttribute(ball(20_000), 3));
      const points = new THREE.Points(geometry, new THREE.PointsMaterial({ size: 1, sizeAttenuation: false }));
      const scene = new THREE.Scene().add(points);
      const camera = new THREE.PerspectiveCamera(40, 1, 0.1, 1000);
      const frame = () => new Promise((resolve) => requestAnimationFrame(resolve));
      const count = () => {
        renderer.render(scene, camera);
        const data = new Uint8Array(4 * 300 * 300);
        renderer.getContext().readPixels(0, 0, 300, 300, 6408, 5121, data);
        return data.filter((byte, i) => i % 4 === 0 && byte > 200).length;
      };
      const filter = new HiddenPointFilter(points, { exponent: 3 });
      let x = 0;
      const move = () => {
        camera.position.set((x += 1e-3), 1, 9);
        camera.lookAt(0, 0, 0);
        filter.update(camera);
      };
      /** What is drawn as soon as the next map has come: before the next frame, the question at rest may be answered. */
      const byMap = async () => {
        let drawn: number | undefined;
        const hear = ({ answer }: { answer: string }) => {
          if (answer === "map") drawn ??= count();
        };
        filter.addEventListener("change", hear);
        while (drawn === undefined) {
          move();
          await frame();
        }
        filter.removeEventListener("change", hear);
        return drawn;
      };
      move();
      const all = count();
      const before = await byMap();
      const loss = renderer.getContext().getExtension("WEBGL_lose_context")!;
      loss.loseContext();
      await frame();
      loss.restoreContext();
      await new Promise((resolve) => {
        renderer.domElement.addEventListener("webglcontextrestored", resolve);
      });
      const report = { all, before, after: await byMap() };
      filter.dispose();
      return report;
    });
    expect(found.all).toBeGreaterThan(1.5 * found.before);
    expect(found.after).toBeLessThan(1.1 * found.before);
    expect(found.after).toBeGreaterThan(0.9 * found.before);
  });
});
