import { CameraHelper, Color, type Object3D, PerspectiveCamera, type Quaternion, Vector3 } from "three";

/** Where the frozen viewpoint is: a small camera in the accent color, of a fixed share of the cloud's size. */
export class ViewpointMarker {
  private readonly parent: Object3D;
  /** Whose accent color it has. */
  private readonly canvas: HTMLCanvasElement;
  private helper: CameraHelper | null = null;
  private readonly at = new Vector3();
  private size = 0;

  constructor(parent: Object3D, canvas: HTMLCanvasElement) {
    this.parent = parent;
    this.canvas = canvas;
  }

  place(at: Vector3, direction: Quaternion, size: number): void {
    this.remove();
    const accent = new Color(getComputedStyle(this.canvas).getPropertyValue("--accent").trim());
    const standing = new PerspectiveCamera(40, 1.4, size * 0.02, size);
    standing.position.copy(at);
    standing.quaternion.copy(direction);
    standing.updateMatrixWorld();
    this.at.copy(at);
    this.size = size;
    this.helper = new CameraHelper(standing);
    this.helper.visible = false;
    this.helper.setColors(accent, accent, accent, accent, accent);
    this.parent.add(this.helper);
  }

  /** From within the marker there would be nothing but its lines across the picture. */
  follow(camera: PerspectiveCamera): void {
    if (this.helper) this.helper.visible = camera.position.distanceTo(this.at) > this.size;
  }

  remove(): void {
    this.helper?.removeFromParent();
    this.helper?.dispose();
    this.helper = null;
  }
}
