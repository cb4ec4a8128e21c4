import { type Layer, LayerExtension } from "@deck.gl/core";

import type { VisibilityMap } from "../cloud/visibility-map.js";
import { GLSL } from "../cloud/visibility-shader.js";

/** A map on the graphics card. */
export interface MapOnCard {
  map: VisibilityMap;
  texture: { destroy(): void };
}

/** What `Device` of luma.gl is used for. */
interface TextureMaker {
  readonly type: string;
  createTexture(props: object): { destroy(): void };
}

const WIDTH = 256;
const NOTHING = new Float32Array(WIDTH);

/** Copies numbers to the card. */
export function textureOf(device: TextureMaker, data: Float32Array = NOTHING): MapOnCard["texture"] {
  const height = Math.max(1, data.length / WIDTH);
  const sampler = { minFilter: "nearest", magFilter: "nearest" };
  return device.createTexture({
    format: "r32float",
    width: WIDTH,
    height,
    data: data.length > 0 ? data : NOTHING,
    sampler,
  });
}

interface MapProps {
  map?: VisibilityMap | undefined;
  texture: MapOnCard["texture"];
}

/** The uniforms `hprViewpoint` and `hprMargins` are in a block, as all of luma.gl's are. */
const module = {
  name: "hprMap",
  vs: `layout(std140) uniform hprMapUniforms {
  float mode;
  highp vec3 eye;
  highp vec3 eyeLow;
  highp vec4 margins;
} hprMap;
${GLSL.replace(/^uniform highp vec\d.*\n/gm, "")
  .replace("hidden(highp vec3 position)", "hprHidden(highp vec3 v)")
  .replace("  highp vec3 v = position - hprViewpoint;\n", "")
  .replaceAll("hprMargins", "hprMap.margins")}`,
  uniformTypes: { mode: "f32", eye: "vec3<f32>", eyeLow: "vec3<f32>", margins: "vec4<f32>" },
  getUniforms: ({ map, texture }: MapProps) => {
    const { viewpoint = [0, 0, 0], uniforms } = map ?? {};
    const eye = viewpoint.map(Math.fround);
    return {
      mode: map === undefined || map.data.length === 0 ? 0 : 1,
      eye,
      eyeLow: viewpoint.map((x, axis) => x - eye[axis]!),
      margins: uniforms?.hprMargins ?? [0, 0, 0, 0],
      hprDepths: texture,
    };
  },
};

type Drawn = Layer & { props: { hprMap?: MapOnCard | undefined }; state: { hprNothing: MapOnCard["texture"] } };

/** Leaves out the points that the map of the property `hprMap` hides. They cannot be picked either. */
export class MapExtension extends LayerExtension {
  static override extensionName = "HiddenPointMap";
  static override defaultProps = { hprMap: { type: "object", value: undefined, optional: true, compare: false } };

  override getShaders(): unknown {
    return {
      modules: [module],
      inject: {
        "vs:#main-end": `
  if (hprMap.mode > 0.5 && hprHidden((instancePositions - hprMap.eye) + (instancePositions64Low - hprMap.eyeLow))) {
    gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
  }`,
      },
    };
  }

  override initializeState(this: Drawn): void {
    this.setState({ hprNothing: textureOf(this.context.device) });
  }

  override draw(this: Drawn): void {
    const { hprMap } = this.props;
    const texture = hprMap?.texture ?? this.state.hprNothing;
    this.setShaderModuleProps({ hprMap: { map: hprMap?.map, texture } });
  }

  override finalizeState(this: Drawn): void {
    this.state.hprNothing.destroy();
  }
}
