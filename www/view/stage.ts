import { type Object3D, PerspectiveCamera, Scene, Vector2, Vector3, WebGLRenderer } from "three";
import { type AllPoints, EyeDome } from "./eye-dome.ts";
import { display, type Theme, THEMES } from "./theme.ts";

/** The canvas: one camera, the shaded points, and an overlay among them without shading. */
export class Stage {
  readonly camera = new PerspectiveCamera(45, 1, 0.01, 100);
  readonly points = new Scene();
  readonly #all: AllPoints = { scene: new Scene(), opacity: 0, alone: 0 };
  readonly overlay = new Scene();
  /** Called before each frame, even if that frame need not be drawn. */
  onFrame: () => void = () => undefined;
  /** Called before a frame whose camera has moved or turned. */
  onCamera: () => void = () => undefined;
  /** Called when the picture has got another size, before it is drawn again. */
  onResize: () => void = () => undefined;
  /** Called when the browser takes the picture's memory away, and when it gives it back. It may do so at any time. */
  onLost: () => void = () => undefined;
  onRestored: () => void = () => undefined;

  readonly #canvas: HTMLCanvasElement;
  readonly #renderer: WebGLRenderer;
  readonly #eyeDome: EyeDome;
  readonly #resizing = new ResizeObserver(() => {
    this.#resize();
    // A resized canvas is empty. It is drawn at once to avoid a flash.
    this.#frame();
  });
  #shape = { width: 1, height: 1 };
  readonly #covered: () => number;
  #free = 1;
  #changed = true;
  #drawnFrom = "";
  /** Whether there has been something to draw. The first frame compiles the shaders, so it must not be an empty one. */
  #isBegun = false;
  /** Whether the picture is wanted, or is taken for a file, and whether its context was given up because it was not. */
  #isWanted = true;
  #isTaken = false;
  #isGivenUp = false;
  /** The ball in which everything is drawn. */
  #extent = { middle: new Vector3(), radius: 1 };

  constructor(canvas: HTMLCanvasElement, covered: () => number = () => 0) {
    this.#canvas = canvas;
    this.#covered = covered;
    this.#renderer = new WebGLRenderer({ canvas, powerPreference: "high-performance" });
    this.#renderer.autoClear = false;
    this.#eyeDome = new EyeDome();
    this.setTheme(THEMES.dark);
    this.#resizing.observe(canvas);
    canvas.addEventListener("webglcontextlost", () => {
      if (!this.#isGivenUp) this.onLost();
      // The event must end first.
      else setTimeout(() => this.#hold());
    });
    canvas.addEventListener("webglcontextrestored", () => {
      if (!this.#isGivenUp) this.onRestored();
      this.#isGivenUp = false;
      this.invalidate();
      this.#hold();
    });
    this.#resize();
    this.#renderer.setAnimationLoop(() => this.#frame());
  }

  /** The size of the picture in CSS pixels. */
  get size(): { width: number; height: number } {
    return this.#shape;
  }

  /** The size of the picture in its own pixels. */
  get resolution(): Vector2 {
    return this.#renderer.getDrawingBufferSize(new Vector2());
  }

  /** Width by height of the picture, and the share of its height, from the top, that nothing covers. */
  get shape(): { aspect: number; free: number } {
    return { aspect: this.camera.aspect, free: this.#free };
  }

  setTheme({ background }: Theme): void {
    this.#eyeDome.setBackground(display(background));
    this.invalidate();
  }

  setExtent(extent: { middle: Vector3; radius: number }): void {
    this.#extent = extent;
    this.invalidate();
  }

  /** The width of a point in the cloud's units. */
  get pointWidth(): number {
    return this.#eyeDome.pointWidth;
  }

  setPointWidth(width: number): void {
    this.#eyeDome.pointWidth = width;
    this.invalidate();
  }

  /** The scene of all points; see `setAll`. */
  get all(): Scene {
    return this.#all.scene;
  }

  /** Draws all points where the answer leaves the picture empty, and alone in a share of its width from the left. */
  setAll(part: Partial<Pick<AllPoints, "opacity" | "alone">>): void {
    const { opacity, alone } = { ...this.#all, ...part };
    if (opacity === this.#all.opacity && alone === this.#all.alone) return;
    Object.assign(this.#all, { opacity, alone });
    this.invalidate();
  }

  setFieldOfView(degrees: number): void {
    this.camera.fov = degrees;
    this.invalidate();
  }

  /** While nobody sees the picture, its context is given up: a browser keeps only a few of them alive. */
  set isWanted(isWanted: boolean) {
    this.#isWanted = isWanted;
    this.#hold();
  }

  #hold(): void {
    const isLost = this.#renderer.getContext().isContextLost();
    const isWanted = this.#isWanted || this.#isTaken;
    if (isWanted && this.#isGivenUp && isLost) {
      this.#renderer.forceContextRestore();
    } else if (!isWanted && !isLost) {
      this.#isGivenUp = true;
      this.#renderer.forceContextLoss();
    }
  }

  /** Draws the next frame although the camera has not moved. */
  invalidate(): void {
    this.#changed = true;
  }

  /** Compiles the shaders of these points before they are drawn. Nothing waits for it. */
  compile(points: Object3D): void {
    this.#eyeDome.compile(this.#renderer, points, this.camera);
  }

  /** Stops drawing and frees the memory of the graphics card. The canvas cannot be used again. */
  dispose(): void {
    this.#resizing.disconnect();
    this.#renderer.setAnimationLoop(null);
    this.#eyeDome.dispose();
    this.#renderer.dispose();
    this.onLost = () => undefined;
    // Browsers would free this context late.
    if (!this.#renderer.getContext().isContextLost()) this.#renderer.forceContextLoss();
  }

  #resize(): void {
    const { clientWidth: width, clientHeight: height } = this.#canvas;
    if (width === 0 || height === 0) return;
    // The shape is kept, because to read it again makes the browser compute the layout.
    this.#shape = { width, height };
    this.#renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.#renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.#free = this.#freeNow;
    this.#fit();
  }

  get #freeNow(): number {
    return Math.max(0.4, 1 - this.#covered() / this.#shape.height);
  }

  /** To be called when more of the picture is covered. What is covered for a moment changes nothing. */
  refit(): void {
    if (this.#freeNow >= this.#free) return;
    this.#free = this.#freeNow;
    this.#fit();
  }

  #fit(): void {
    const { width, height } = this.#shape;
    // The middle of the free part is the middle of the picture.
    this.camera.setViewOffset(width, height, 0, ((1 - this.#free) * height) / 2, width, height);
    this.onResize();
    this.invalidate();
  }

  /** Pixels of the picture for each CSS pixel. */
  get pixelRatio(): number {
    return this.#renderer.getPixelRatio();
  }

  /** Returns the present picture as a PNG file. Rejects if there is no picture. */
  async snapshot(): Promise<Blob> {
    this.#isTaken = true;
    try {
      if (this.#isGivenUp) {
        const restored = new Promise((resolve) =>
          this.#canvas.addEventListener("webglcontextrestored", resolve, { once: true }),
        );
        this.#hold();
        await restored;
      }
      return await this.#snapshot();
    } finally {
      this.#isTaken = false;
      this.#hold();
    }
  }

  #snapshot(): Promise<Blob> {
    if (this.#renderer.getContext().isContextLost()) {
      return Promise.reject(new Error("the browser has taken the picture away"));
    }
    // A picture can be read only until the browser has shown it.
    this.invalidate();
    this.#frame();
    return new Promise((resolve, reject) => {
      this.#canvas.toBlob((file) => {
        if (file) resolve(file);
        else reject(new Error("the browser makes no picture of this size"));
      }, "image/png");
    });
  }

  #frame(): void {
    this.camera.updateMatrixWorld();
    this.onFrame();
    const from = this.camera.matrixWorld.elements.join();
    if (!this.#changed && from === this.#drawnFrom) return;
    this.#isBegun ||= [this.points, this.all, this.overlay].some(({ children }) => children.length > 0);
    if (!this.#isBegun || this.#isGivenUp) return;
    if (from !== this.#drawnFrom) this.onCamera();
    this.#changed = false;
    this.#drawnFrom = from;

    Object.assign(this.camera, clipping(this.camera.position.distanceTo(this.#extent.middle), this.#extent.radius));
    this.camera.updateProjectionMatrix();

    this.#eyeDome.render(this.#renderer, this.points, this.#all, this.camera);
    this.#renderer.render(this.overlay, this.camera);
  }
}

/**
 * The two distances between which a thing is drawn. They are as near to each other as possible, since clouds of a
 * millimeter and of a hundred kilometers share one depth buffer.
 */
export function clipping(distance: number, extent: number): { near: number; far: number } {
  const far = distance + 1.1 * extent;
  return { near: Math.max(distance - 1.1 * extent, far / 5000), far };
}
