import { CompositeLayer, type DefaultProps, type Layer, LayerExtension, type UpdateParameters } from "@deck.gl/core";
import { DataFilterExtension } from "@deck.gl/extensions";
import { PointCloudLayer, type PointCloudLayerProps } from "@deck.gl/layers";
import { asError, HprError } from "../base/errors.js";
import {
  type AnswerKind,
  FOLLOW_OPTIONS,
  type FollowedOptions,
  type FollowOptions,
  type FollowSettings,
  followSettings,
} from "../follow/options.js";
import { givenOptions } from "../query/options.js";
import { VIEW_OPTIONS, type VisibilityOptions } from "../query/view-options.js";
import type { Visibility } from "../cloud/visibility.js";
import type { VisibilityMap } from "../cloud/visibility-map.js";
import { Frame, isBinary, positionsOf } from "./frame.js";
import { LayerCloud } from "./layer-cloud.js";
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

/** The properties of a `PointCloudLayer`, and the viewpoint. */
export type VisiblePointCloudLayerProps<DataT = unknown> = PointCloudLayerProps<DataT> & {
  /**
   * The viewpoint: x, y, z in the data's own coordinates. Default: the place of the view's camera,
   * or its direction if it is orthographic. The default is refused (`option`) for a globe, for
   * Cartesian coordinates in a geospatial view, and if `modelMatrix` scales the axes differently.
   *
   * Data in degrees (`lnglat`, `lnglat-offsets`) is converted to meters around its middle. A `radius`
   * and the distances of `within` are then in meters, otherwise in the data's own units.
   */
  viewpoint?: readonly [number, number, number] | null;
  /** How each view is computed, and how answers follow the viewpoint. */
  visibility?: FollowedOptions & FollowOptions;
  /**
   * A new answer is drawn. `answer` says what it is, and `visible` holds the indices of the points that are drawn.
   * Maps, by which the card leaves out points while the camera moves, are not told.
   */
  onVisible?: ((answer: VisibleAnswer) => void) | null;
};

/** What `onVisible` is told. */
export interface VisibleAnswer {
  /** The number of points that are drawn. */
  count: number;
  /** The time that the answer took. */
  milliseconds: number;
  /** What the answer is. */
  answer: AnswerKind;
  /** The indices of the points that are drawn, ascending. */
  visible: Uint32Array;
  /** Whether it is final: no better answer comes until the view or the data changes. */
  settled: boolean;
}

interface Own {
  viewpoint: readonly number[] | null;
  visibility: FollowedOptions & FollowOptions;
  onVisible: ((answer: VisibleAnswer) => void) | null;
  getPosition: unknown;
}

// This is not an interface, since an interface has no index signature.
type State = {
  cloud: LayerCloud;
  /** The property `visibility`, and its content. */
  read: { given: unknown; text: string; settings: FollowSettings } | undefined;
  /** The cloud's coordinates. */
  frame: Frame | undefined;
  /** The message of the last refusal. A camera that goes on moving does not report it again. */
  refusal: string | undefined;
  /**
   * One number for each point: 1 if it is visible, 0 if it is hidden. Undefined before the first
   * answer. Later answers overwrite the array.
   */
  mask: Float32Array | undefined;
  /** The number of answers so far. */
  version: number;
  /** The data with the mask as an attribute, if the data is binary. */
  data: unknown;
  /** The map that is drawn instead of an answer. */
  map: MapOnCard | undefined;
};

type Update = Pick<UpdateParameters<Layer>, "changeFlags">;

const NO_OPTIONS: VisibilityOptions = {};
const filter = new DataFilterExtension({ filterSize: 1 });
const mapped = new MapExtension();
let hasSaid = false;
const VISIBLE: [number, number] = [0.5, 1.5];
/** deck.gl shows a layer this view before the first true one. */
const NO_VIEW_YET = "DEFAULT-INITIAL-VIEWPORT";
/**
 * If the page changes its layers and its view, one of them may meet the other's state before. A refusal lasts if it is still
 * there after so many milliseconds, and after deck.gl has drawn two more frames: on a busy machine frames come late.
 */
const LASTING = 200;

/**
 * A deck.gl `PointCloudLayer` that draws only the points that the camera sees. Only these points can
 * be picked. The answer comes from a worker that all layers share. A `DataFilterExtension` applies
 * the answer on the graphics card. Before the first answer, all points are drawn.
 *
 * ```js
 * new VisiblePointCloudLayer({
 *   id: "scan",
 *   data: { length, attributes: { getPosition: { value: positions, size: 3 } } },
 *   pointSize: 2,
 *   visibility: { exponent: 3 },
 * });
 * ```
 *
 * If something is refused, the layer raises an `HprError`, like any error of a layer (`onError`).
 */
export class VisiblePointCloudLayer<DataT = unknown> extends CompositeLayer<VisiblePointCloudLayerProps<DataT>> {
  static override layerName = "VisiblePointCloudLayer";
  static override defaultProps: DefaultProps<VisiblePointCloudLayerProps> = {
    ...(PointCloudLayer.defaultProps as DefaultProps<VisiblePointCloudLayerProps>),
    viewpoint: { type: "object", value: null, optional: true, compare: true },
    visibility: { type: "object", value: NO_OPTIONS, compare: 2 },
    onVisible: { type: "function", value: null, optional: true },
  };

  /** @internal */
  declare state: State;

  /** @internal */
  override initializeState(): void {
    const cloud = new LayerCloud({
      answer: (answer, kind, milliseconds) => {
        (this.getCurrentLayer() as this | null)?.applyAnswer(answer, kind, milliseconds);
      },
      map: (map) => (this.getCurrentLayer() as this | null)?.applyMap(map),
      error: (error) => this.getCurrentLayer()?.raiseError(error, ""),
    });
    this.setState({
      cloud,
      read: undefined,
      frame: undefined,
      refusal: undefined,
      mask: undefined,
      version: 0,
      data: undefined,
      map: undefined,
    });
  }

  /** Returns true for each change, also if only the camera has moved. @internal */
  override shouldUpdateState({ changeFlags }: Update): boolean {
    return changeFlags.somethingChanged;
  }

  /** @internal */
  override updateState({ changeFlags }: Update): void {
    if (this.context.viewport.id === NO_VIEW_YET) return;
    if (changeFlags.dataChanged) this.state.refusal = undefined;
    try {
      this.#look(changeFlags);
      this.state.refusal = undefined;
    } catch (thrown) {
      this.#refuse(asError(thrown));
    }
  }

  /** Draws all points. Reports the refusal once, and only if it lasts. */
  #refuse(error: Error): void {
    if (this.state.refusal === error.message) return;
    this.#drawAll();
    this.setState({ refusal: error.message });
    const report = () => {
      const layer = this.getCurrentLayer() as this | null;
      if (layer?.state.refusal === error.message) layer.raiseError(error, "");
    };
    setTimeout(() => requestAnimationFrame(() => requestAnimationFrame(report)), LASTING);
  }

  #look({ dataChanged, updateTriggersChanged: triggers }: Update["changeFlags"]): void {
    const { cloud } = this.state;
    const { data, getPosition, viewpoint, visibility } = this.props as unknown as Own & { data: unknown };
    const { viewport } = this.context;
    const earlier = this.state.frame;
    const frame = (this.state.frame = new Frame(viewport, this.props));
    const isMoved = typeof triggers === "object" && ("getPosition" in triggers || "all" in triggers);
    if (dataChanged || isMoved || earlier?.key !== frame.key) {
      this.#drawAll();
      cloud.setPositions(() => frame.take(positionsOf(data, getPosition)));
    } else {
      frame.goOn(earlier);
    }
    const place = viewpoint === null ? frame.seen(viewport) : frame.given(viewpoint);
    const settings = this.#settingsOf(visibility);
    const drawsMaps = frame.isOwn && this.context.device.type === "webgl";
    if (!drawsMaps && settings.mapped !== undefined && !hasSaid) {
      hasSaid = true;
      console.info(
        "hidden-point-removal: data in degrees takes no map of directions, so the last answer stays while the view moves",
      );
    }
    if (cloud.want(place, settings, drawsMaps)) this.#drawAll();
  }

  /** Draws all points until the next answer. */
  #drawAll(): void {
    const { mask, map } = this.state;
    if (mask !== undefined || map !== undefined) {
      map?.texture.destroy();
      this.setState({ mask: undefined, data: undefined, map: undefined });
    }
  }

  /** @internal */
  override finalizeState(): void {
    this.state.cloud.dispose();
    this.state.map?.texture.destroy();
  }

  /** @internal */
  override renderLayers(): Layer {
    const { mask, version, data = this.props.data, map } = this.state;
    const { extensions, updateTriggers } = this.props;
    const own = Object.entries(this.props).filter(([name]) => name in PointCloudLayer.defaultProps);
    const shared = this.getSubLayerProps({
      id: "points",
      updateTriggers: { ...updateTriggers, getFilterValue: version },
    }) as object;
    return new PointCloudLayer({
      ...Object.fromEntries(own),
      ...shared,
      data,
      extensions: [...extensions, filter, mapped],
      hprMap: map,
      getFilterValue: (_: unknown, { index }: { index: number }) => mask?.[index] ?? 1,
      filterRange: VISIBLE,
      filterEnabled: mask !== undefined && map === undefined,
    } as never);
  }

  /** Options with the same content are read once. */
  #settingsOf(visibility: Own["visibility"]): FollowSettings {
    let { read } = this.state;
    if (read?.given !== visibility) {
      const text = JSON.stringify(visibility);
      const given = givenOptions(visibility, VIEW_OPTIONS, FOLLOW_OPTIONS);
      const settings = read?.text === text ? read.settings : followSettings(given, { hasShaders: true });
      if (settings.stages.some((stage) => stage.options.scores === true)) {
        throw new HprError("option", "scores have no effect in this layer; leave them out");
      }
      this.state.read = read = { given: visibility, text, settings };
    }
    return read.settings;
  }

  /** @internal */
  applyAnswer(answer: Visibility, kind: AnswerKind, milliseconds: number): void {
    const { cloud, version } = this.state;
    let { mask } = this.state;
    if (mask?.length !== cloud.length) mask = new Float32Array(cloud.length);
    mask.fill(0);
    for (const index of answer.indices) mask[index] = 1;
    const data: unknown = this.props.data;
    const withMask = isBinary(data)
      ? { ...data, attributes: { ...data.attributes, getFilterValue: { value: mask, size: 1 } } }
      : undefined;
    this.state.map?.texture.destroy();
    this.setState({ mask, version: version + 1, data: withMask, map: undefined });
    (this.props as unknown as Own).onVisible?.({
      count: answer.count,
      milliseconds,
      answer: kind,
      visible: answer.indices,
      settled: cloud.settled,
    });
  }

  /** @internal */
  applyMap(map: VisibilityMap): void {
    this.state.map?.texture.destroy();
    const texture = textureOf(this.context.device, map.data);
    this.setState({ map: { map, texture } });
  }
}
