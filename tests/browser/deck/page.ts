// A page with one deck.gl layer. `page` lets the test change it.
import { Deck, FirstPersonView, type Layer, OrbitView, type OrbitViewState } from "@deck.gl/core";
import { PointCloud, init } from "hidden-point-removal";
import { VisiblePointCloudLayer, type VisiblePointCloudLayerProps } from "hidden-point-removal/deck";

type Props = Partial<VisiblePointCloudLayerProps>;

export interface DeckPage {
  answers: { count: number; answer: string }[];
  errors: string[];
  positions: Float32Array;
  /** The camera's place, from the view itself. */
  camera: () => number[];
  layer: () => Layer;
  /** The filter values of the layer with the points. */
  values: () => number[];
  set: (props: Props, viewState?: Partial<OrbitViewState>) => void;
  /** Looks with a geospatial camera from this place: meters from a longitude and latitude. */
  lookFrom: (home: [number, number], position: number[], changed: Props) => void;
  visibleFrom: (viewpoint: number[], positions?: number[]) => Promise<number[]>;
  /** How many workers were started. */
  workers: () => number;
  /** Ends this many workers, each as soon as it is asked about a view. */
  killWorkerWhenAsked: (times?: number) => void;
  /** Workers hear nothing from now on. */
  silence: () => void;
  pick: (x: number, y: number) => Promise<number | undefined>;
  /** The points in the picture, from the pixels that deck.gl draws to pick from. */
  drawn: () => Promise<number[]>;
  /** Whether the picture is drawn by a map. */
  isMapped: () => boolean;
}

const workers: Worker[] = [];
let toKill = 0;
let isSilent = false;
const OwnWorker = Worker;
globalThis.Worker = class extends OwnWorker {
  constructor(...args: ConstructorParameters<typeof Worker>) {
    super(...args);
    workers.push(this);
  }

  override postMessage(message: unknown, ...transfer: never[]): void {
    if (!isSilent) super.postMessage(message, ...transfer);
    const { kind } = (message as { content: { kind: string } }).content;
    if (kind === "visibleFrom" && toKill > 0) {
      toKill -= 1;
      this.terminate();
      setTimeout(() => {
        kill(this);
      });
    }
  }
};

const positions = new Float32Array(layers());
const binary = { length: positions.length / 3, attributes: { getPosition: { value: positions, size: 3 } } };
let viewState: OrbitViewState = { target: [0, 0, 0], zoom: 6, rotationX: 90, rotationOrbit: 0 };
let props: Props = { data: binary as never, visibility: { exponent: 3 } };

const deck = new Deck({
  parent: document.getElementById("root") as HTMLDivElement,
  width: 300,
  height: 300,
  views: new OrbitView({ id: "view" }),
  viewState,
  layers: [layerOf()],
  onError: (error) => page.errors.push((error as { code?: string }).code ?? error.message),
});

const page: DeckPage = {
  answers: [],
  errors: [],
  positions,
  camera: () => deck.getViewports()[0]!.cameraPosition,
  layer: () => sublayer(),
  values: () => {
    const { data, getFilterValue } = sublayer().props as unknown as {
      data: { length: number; attributes?: { getFilterValue?: { value: Float32Array } } };
      getFilterValue: (object: unknown, info: { index: number }) => number;
    };
    const told = data.attributes?.getFilterValue?.value;
    return Array.from({ length: data.length }, (_, index) => told?.[index] ?? getFilterValue(null, { index }));
  },
  set: (changed, view = {}) => {
    props = { ...props, ...changed };
    viewState = { ...viewState, ...view };
    deck.setProps({ viewState, layers: [layerOf()] });
  },
  lookFrom: ([longitude, latitude], position, changed) => {
    props = { ...props, ...changed };
    deck.setProps({
      views: new FirstPersonView({ id: "street" }) as never,
      viewState: { longitude, latitude, position, bearing: 0, pitch: 0 } as never,
      layers: [layerOf()],
    });
  },
  visibleFrom: async (viewpoint, of = [...positions]) => {
    await init();
    return [...new PointCloud(of).visibleFrom(viewpoint, { exponent: 3 }).indices];
  },
  workers: () => workers.length,
  killWorkerWhenAsked: (times = 1) => {
    toKill = times;
  },
  silence: () => {
    isSilent = true;
  },
  pick: async (x, y) => (await deck.pickObjectAsync({ x, y, radius: 3 }))?.index,
  drawn: async () => (await deck.pickObjectsAsync({ x: 0, y: 0, width: 300, height: 300 })).map(({ index }) => index),
  isMapped: () => (sublayer().props as { hprMap?: unknown }).hprMap !== undefined,
};
(globalThis as unknown as { page: DeckPage }).page = page;

function kill(worker: Worker): void {
  worker.terminate();
  worker.dispatchEvent(new ErrorEvent("error", { message: "killed", cancelable: true }));
}

function layerOf(): VisiblePointCloudLayer {
  return new VisiblePointCloudLayer({
    id: "scan",
    coordinateSystem: "cartesian",
    pointSize: 2,
    getColor: [255, 0, 0],
    pickable: true,
    onVisible: (answer) => page.answers.push(answer),
    ...props,
  });
}

function sublayer(): Layer {
  const { layerManager } = deck as unknown as { layerManager: { getLayers: () => Layer[] } };
  return layerManager.getLayers().find(({ id }) => id === "scan-points")!;
}

/** Two discs of points, the second behind the first. */
function layers(): number[] {
  return Array.from({ length: 2000 }, (_, i) => {
    const [r, turn] = [Math.sqrt((i + 0.5) / 2000), 2.399963 * i];
    return [r * Math.cos(turn), r * Math.sin(turn), 0, r * Math.cos(turn), r * Math.sin(turn), -0.5];
  }).flat();
}
