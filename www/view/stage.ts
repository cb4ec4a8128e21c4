import { PerspectiveCamera, Scene, WebGLRenderer } from "three";
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

  private readonly canvas: HTMLCanvasElement;
  private readonly renderer: WebGLRenderer;
  private readonly eyeDome: EyeDome;
  private changed = true;
  private drawnFrom = "";
  /** Half the size of what is to be seen, around the origin. */
  private extent = 1;
  private throughOpacity = 1;

  constructor(canvas: HTMLCanvasElement) {
    this.canvas = canvas;
    this.renderer = new WebGLRenderer({ canvas, powerPreference: "high-performance" });
    this.renderer.autoClear = false;
    this.eyeDome = new EyeDome();
    this.setTheme(THEMES.dark);
    new ResizeObserver(() => { this.resize(); }).observe(canvas);
    canvas.addEventListener("webglcontextrestored", () => { this.invalidate(); });
    this.resize();
    this.renderer.setAnimationLoop(() => { this.frame(); });
  }

  /** Of the picture in CSS pixels. */
  get size(): { width: number; height: number } {
    return { width: this.canvas.clientWidth, height: this.canvas.clientHeight };
  }

  setTheme({ background }: Theme): void {
    this.eyeDome.setBackground(display(background));
    this.invalidate();
  }

  setExtent(extent: number): void {
    this.extent = extent;
    this.invalidate();
  }

  /** In the cloud's units. */
  setPointWidth(width: number): void {
    this.eyeDome.pointWidth = width;
    this.invalidate();
  }

  /** Whether points are shaded by how far their neighbors stand in front of them. */
  setEyeDome(enabled: boolean): void {
    this.eyeDome.enabled = enabled;
    this.invalidate();
  }

  /** How much of the points drawn through the others is seen. */
  setThroughOpacity(opacity: number): void {
    this.throughOpacity = opacity;
    this.invalidate();
  }

  setFieldOfView(degrees: number): void {
    this.camera.fov = degrees;
    this.invalidate();
  }

  /** Something other than the camera has changed: draw again. */
  invalidate(): void {
    this.changed = true;
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.onResize();
    this.invalidate();
    // A resized canvas is empty; drawing at once avoids a flash.
    this.frame();
  }

  /** The picture as it is now, as a PNG file. */
  snapshot(): Promise<Blob> {
    // What is drawn is there to be read until the browser has shown it.
    this.invalidate();
    this.frame();
    return new Promise((resolve, reject) => {
      this.canvas.toBlob((file) => {
        if (file) resolve(file);
        else reject(new Error("the browser makes no picture of this size"));
      }, "image/png");
    });
  }

  private frame(): void {
    this.camera.updateMatrixWorld();
    this.onFrame();
    const from = this.camera.matrixWorld.elements.join();
    if (!this.changed && from === this.drawnFrom) return;
    if (from !== this.drawnFrom) this.onCamera();
    this.changed = false;
    this.drawnFrom = from;

    // As tight as the cloud allows: the depth buffer is shared by clouds of a millimeter and of a hundred kilometers.
    const distance = this.camera.position.length();
    this.camera.far = distance + 1.1 * this.extent;
    this.camera.near = Math.max(distance - 1.1 * this.extent, this.camera.far / 5000);
    this.camera.updateProjectionMatrix();

    this.eyeDome.render(this.renderer, this.points, this.camera);
    if (this.through.children.some((child) => child.visible)) {
      this.eyeDome.renderOver(this.renderer, this.through, this.camera, this.throughOpacity);
    }
    this.renderer.render(this.overlay, this.camera);
  }
}

/** Whether this browser can draw at all; asked of a canvas of its own, so that nothing is logged where it cannot. */
export function canDraw(): boolean {
  const context = document.createElement("canvas").getContext("webgl2");
  context?.getExtension("WEBGL_lose_context")?.loseContext();
  return context !== null;
}
