import { CameraHelper, Color, type Object3D, PerspectiveCamera } from "three";

/** Where the frozen viewpoint is: a small camera in the accent color, of a fixed share of the cloud's size. */
export class ViewpointMarker {
  private readonly parent: Object3D;
  private helper: CameraHelper | null = null;

  constructor(parent: Object3D) {
    this.parent = parent;
  }

  /** Takes the place and direction of `camera`. */
  place(camera: PerspectiveCamera, size: number): void {
    this.remove();
    const accent = new Color(getComputedStyle(document.documentElement).getPropertyValue("--accent").trim());
    const standing = new PerspectiveCamera(40, 1.4, size * 0.02, size);
    standing.position.copy(camera.position);
    standing.quaternion.copy(camera.quaternion);
    standing.updateMatrixWorld();
    this.helper = new CameraHelper(standing);
    this.helper.setColors(accent, accent, accent, accent, accent);
    this.parent.add(this.helper);
  }

  remove(): void {
    this.helper?.removeFromParent();
    this.helper?.dispose();
    this.helper = null;
  }
}
