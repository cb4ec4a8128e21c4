import { BufferAttribute, BufferGeometry, DoubleSide, DynamicDrawUsage, Mesh, ShaderMaterial } from "three";
import { type CloudAttributes, display, TINT_SHADER } from "./attributes.ts";
import type { Theme } from "./theme.ts";

const vertexShader = /* glsl */ `
  ${TINT_SHADER}
  varying vec3 tint, place;
  varying float bright;

  void main() {
    vec4 seen = modelViewMatrix * vec4(position, 1.0);
    place = seen.xyz;
    tint = ownTint();
    bright = light();
    gl_Position = projectionMatrix * seen;
  }
`;

const fragmentShader = /* glsl */ `
  uniform bool lit;
  /* The color of the surface's inside, which is seen if the viewpoint is frozen and the camera behind the surface. */
  uniform vec3 inside;
  varying vec3 tint, place;
  varying float bright;

  void main() {
    vec3 base = gl_FrontFacing ? tint : inside;
    // If there are lights, only they shade; otherwise a lamp a little above the viewer does.
    float shade = bright;
    if (!lit) {
      vec3 across = normalize(cross(dFdx(place), dFdy(place)));
      vec3 toLamp = normalize(normalize(-place) + vec3(-0.25, 0.45, 0.0));
      shade = mix(0.22, 1.0, max(0.0, dot(across, toLamp)));
    }
    gl_FragColor = vec4(base * shade, 1.0);
  }
`;

/** The reconstructed surface: flat triangles between the cloud's own points. */
export class Surface {
  readonly mesh: Mesh<BufferGeometry, ShaderMaterial>;

  constructor(attributes: CloudAttributes, theme: Theme) {
    const geometry = new BufferGeometry();
    attributes.addTo(geometry);
    geometry.setDrawRange(0, 0);
    const material = new ShaderMaterial({
      vertexShader,
      fragmentShader,
      uniforms: { ...attributes.uniforms, inside: { value: display(theme.inside) } },
      side: DoubleSide,
    });
    this.mesh = new Mesh(geometry, material);
    this.mesh.frustumCulled = false;
    this.mesh.visible = false;
  }

  setTheme({ inside }: Theme): void {
    this.mesh.material.uniforms["inside"]!.value = display(inside);
  }

  /** `null` hides the surface. */
  setTriangles(triangles: Uint32Array | null): void {
    this.mesh.visible = triangles !== null;
    if (!triangles) return;
    const { geometry } = this.mesh;
    const last = geometry.index;
    // A little more than needed, so that most answers need no new memory on the graphics card.
    const index =
      last && triangles.length <= last.array.length
        ? last
        : new BufferAttribute(new Uint32Array(Math.ceil(1.3 * triangles.length)), 1);
    (index.array as Uint32Array).set(triangles);
    if (index !== last) geometry.setIndex(index.setUsage(DynamicDrawUsage));
    index.needsUpdate = true;
    geometry.setDrawRange(0, triangles.length);
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
  }
}
