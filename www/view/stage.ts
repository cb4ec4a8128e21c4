import { PerspectiveCamera, Scene, Vector2, WebGLRenderer } from "three";
import { display } from "./attributes.ts";
import { EyeDome } from "./eye-dome.ts";
import { type Theme, THEMES } from "./theme.ts";

/** The canvas: one camera, the shaded points, those drawn through them, and an overlay of what is drawn among them unshaded. */
export class Stage {
  readonly camera = new PerspectiveCamera(45, 1, 0.01, 100);
  readonly points = new Scene();
  readonly through = new Scene();
  readonly overlay = new Scene();
  /** Called before each frame is drawn or found unchanged. */
  onFrame: () => void = () => undefined;
  /** Called before a frame from another place, or in another direction, than the last. */
  onCamera: () => void = () => undefined;
  /** Called when the picture has got another shape, before it is drawn anew. */
  onResize: () => void = () => undefined;
  /** Called when the browser takes the picture's memory away, as it may at any time, and when it gives it back. */
  onLost: () => void = () => undefined;
  onRestored: () => void = () => undefined;

  readonly #canvas: HTMLCanvasElement;
  readonly #renderer: WebGLRenderer;
  readonly #eyeDome: EyeDome;
  readonly #resizing = new ResizeObserver(() => {
    this.#resize();
    // A resized canvas is empty; drawing at once avoids a flash.
    this.#frame();
  });
  #shape = { width: 1, height: 1 };
  #changed = true;
  #drawnFrom = "";
  /** Half the size of what is to be seen, around the origin. */
  #extent = 1;
  #throughOpacity = 1;

  constructor(canvas: HTMLCanvasElement) {
    this.#canvas = canvas;
    this.#renderer = new WebGLRenderer({ canvas, powerPreference: "high-performance" });
    this.#renderer.autoClear = false;
    this.#eyeDome = new EyeDome();
    this.setTheme(THEMES.dark);
    this.#resizing.observe(canvas);
    canvas.addEventListener("webglcontextlost", () => {
      this.onLost();
    });
    canvas.addEventListener("webglcontextrestored", () => {
      this.invalidate();
      this.onRestored();
    });
    this.#resize();
    this.#renderer.setAnimationLoop(() => {
      this.#frame();
    });
  }

  /** Of the picture in CSS pixels. */
  get size(): { width: number; height: number } {
    return this.#shape;
  }

  /** Of the picture in its own pixels. */
  get resolution(): Vector2 {
    return this.#renderer.getDrawingBufferSize(new Vector2());
  }

  setTheme({ background }: Theme): void {
    this.#eyeDome.setBackground(display(background));
    this.invalidate();
  }

  setExtent(extent: number): void {
    this.#extent = extent;
    this.invalidate();
  }

  /** Of a point, in the cloud's units. */
  get pointWidth(): number {
    return this.#eyeDome.pointWidth;
  }

  setPointWidth(width: number): void {
    this.#eyeDome.pointWidth = width;
    this.invalidate();
  }

  /** Whether points are shaded by how far their neighbors stand in front of them. */
  setEyeDome(enabled: boolean): void {
    this.#eyeDome.enabled = enabled;
    this.invalidate();
  }

  /** How much of the points drawn through the others is seen. */
  setThroughOpacity(opacity: number): void {
    this.#throughOpacity = opacity;
    this.invalidate();
  }

  setFieldOfView(degrees: number): void {
    this.camera.fov = degrees;
    this.invalidate();
  }

  /** Something other than the camera has changed: draw again. */
  invalidate(): void {
    this.#changed = true;
  }

  /** Draws no more, and gives the graphics card its memory back; the canvas is of no further use. */
  dispose(): void {
    this.#resizing.disconnect();
    this.#renderer.setAnimationLoop(null);
    this.#eyeDome.dispose();
    this.#renderer.dispose();
    this.onLost = () => undefined;
    // Browsers keep only so many pictures alive, and a context goes late by itself.
    this.#renderer.forceContextLoss();
  }

  #resize(): void {
    const { clientWidth: width, clientHeight: height } = this.#canvas;
    if (width === 0 || height === 0) return;
    // Asked of the document once: each time it would have to be laid out first.
    this.#shape = { width, height };
    this.#renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.#renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.onResize();
    this.invalidate();
  }

  /** How many of its own pixels the picture has for each CSS pixel. */
  get pixelRatio(): number {
    return this.#renderer.getPixelRatio();
  }

  /** The picture as it is now, as a PNG file; rejects where there is none. */
  snapshot(): Promise<Blob> {
    if (this.#renderer.getContext().isContextLost())
      return Promise.reject(new Error("the browser has taken the picture away"));
    // What is drawn is there to be read until the browser has shown it.
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
    if (from !== this.#drawnFrom) this.onCamera();
    this.#changed = false;
    this.#drawnFrom = from;

    Object.assign(this.camera, clipping(this.camera.position.length(), this.#extent));
    this.camera.updateProjectionMatrix();

    this.#eyeDome.render(this.#renderer, this.points, this.camera);
    if (this.through.children.some((child) => child.visible)) {
      this.#eyeDome.renderOver(this.#renderer, this.through, this.camera, this.#throughOpacity);
    }
    this.#renderer.render(this.overlay, this.camera);
  }
}

/**
 * Between which distances something of that extent, so far away, is drawn. As tight as it allows: the depth buffer is shared
 * by clouds of a millimeter and of a hundred kilometers.
 */
export function clipping(distance: number, extent: number): { near: number; far: number } {
  const far = distance + 1.1 * extent;
  return { near: Math.max(distance - 1.1 * extent, far / 5000), far };
}

/** What three.js asks for. */
const CONTEXT: WebGLContextAttributes = { alpha: true, antialias: false, powerPreference: "high-performance" };

/** Whether this browser can draw on a canvas: asked before three.js, which logs where it cannot, and takes over the context that is made here. */
export function canDraw(canvas: HTMLCanvasElement): boolean {
  return canvas.getContext("webgl2", CONTEXT) !== null;
}
