import { HprError } from "hidden-point-removal";
import { WorkerPointCloud } from "hidden-point-removal/worker";
import { prepareCloud, type Up } from "./cloud.ts";
import { loadCloud, LoadProblem, type LoadRequest } from "./loaders/index.ts";
import { Controls, usualFieldOfView, usualPointSize } from "./panel/controls.ts";
import { byId } from "./panel/dom.ts";
import { FirstLoad } from "./panel/first-load.ts";
import { onFile } from "./panel/files.ts";
import type { Message } from "./panel/message.ts";
import { Progress } from "./panel/progress.ts";
import { SamplePicker } from "./panel/sample-picker.ts";
import type { Params } from "./params.ts";
import { Refilter, type Viewpoint } from "./refilter.ts";
import { type Sample, sampleNamed } from "./samples.ts";
import type { Status } from "./status.ts";
import { findHome, isInReach } from "./view/framing.ts";
import { Viewer } from "./viewer.ts";

/** What is to be opened, and how it is to be seen. */
interface Source {
  request: LoadRequest;
  sample: Sample | null;
  view: Viewpoint | null;
  /** What the user has to know about it besides. */
  notes: string[];
  /** What could not be opened, so that this one is in its place. */
  insteadOf?: string;
}

/** From the address of the page to a cloud on screen, and from there to every other cloud the user opens. */
export function startSession(params: Params, status: Status, message: Message): void {
  const viewer = new Viewer(byId("view", HTMLCanvasElement));
  const controls = new Controls(viewer, params.exponent);
  const progress = new Progress();
  const firstLoad = new FirstLoad();
  let loading = new AbortController();

  const picker = new SamplePicker((sample) => {
    rememberInAddress(sample);
    void open(fromSample(sample, null));
  });
  onFile({
    open: (file, notes) => void open({ request: { kind: "file", name: file.name, file, skipNonFinite: false }, sample: null, view: null, notes }),
    refuse: (sentence) => {
      message.show(sentence);
    },
  });

  controls.onFreeze = (frozen) => {
    status.describe(frozen);
  };
  viewer.onAnswer = (answer, total) => {
    controls.follow(answer);
    status.answer(answer, total, controls.frozen);
  };
  viewer.onError = (error) => {
    refuse(error, "The visible points could not be found");
  };
  const first = params.src === null ? fromSample(sampleNamed(params.sample), params.view) : fromAddress(params.src, params.view);
  void open({ ...first, notes: params.notes });

  /** Loads a cloud beside the one on screen; it takes that one's place once the first answer is there. */
  async function open(source: Source): Promise<void> {
    loading.abort();
    const { signal } = (loading = new AbortController());
    const { request, sample, notes, insteadOf } = source;
    const say = (sentence: string) => {
      // What went wrong is to be read until the user does something else.
      if (insteadOf === undefined) status.loading(sentence);
      firstLoad.say(sentence);
    };
    if (notes.length > 0) message.show(notes.join(" "));
    else if (insteadOf === undefined) message.hide();
    say(`Loading ${request.name}.`);
    progress.show(null);
    let refilter: Refilter | null = null;
    try {
      const loaded = await loadCloud(request, signal, (step, fraction) => {
        say(`${step} ${request.name}.`);
        progress.show(fraction);
      });
      say(`Finding the visible points of ${request.name}.`);
      progress.show(null);
      const up = sample?.up ?? loaded.taken?.up ?? usualUp(request.name);
      const cloud = prepareCloud(loaded);
      const fov = usualFieldOfView(sample);
      const tooFar = source.view !== null && !isInReach(cloud, source.view);
      if (tooFar) message.show([...notes, "The view in the address is too far away to see anything, so the usual view is used."].join(" "));
      const view = (tooFar ? null : source.view) ?? loaded.taken?.from ?? null;
      const homeWith = (upward: Up) => {
        const lens = { fov, aspect: viewer.stage.camera.aspect };
        return upward === up ? findHome(cloud, up, sample, view, lens) : findHome(cloud, upward, null, null, lens);
      };
      const home = homeWith(up);
      const worker = await WorkerPointCloud.create(loaded.positions, { transfer: true, signal });
      refilter = new Refilter(worker, cloud.radius);
      const answer = await refilter.ask({ viewpoint: home.viewpoint, exponent: viewer.exponent });
      signal.throwIfAborted();
      status.loaded();
      controls.prepare({ fieldOfView: fov, pointSize: usualPointSize(sample, cloud.count), up });
      viewer.show({ cloud, refilter, home, up, answer, findHome: homeWith });
      firstLoad.hide();
      if (insteadOf !== undefined) status.error(insteadOf);
      if (sample) picker.showSample(sample);
      else picker.showOwn(request.name);
    } catch (error) {
      refilter?.dispose();
      if (signal.aborted) return;
      progress.hide();
      refuse(error, `${request.name} could not be opened`, source);
      return;
    }
    progress.hide();
  }

  function refuse(error: unknown, what: string, source?: Source): void {
    const sentence = error instanceof LoadProblem ? error.message : `${what}: ${plain(error)}.`;
    status.error(sentence);
    const again = source && withoutNonFinite(error, source);
    message.show(sentence, again ? [{ label: "Load without them", run: () => void open(again) }] : []);
    picker.restore();
    // Not to leave the page empty where nothing has been opened before.
    const usual = sampleNamed(params.sample);
    if (viewer.isEmpty && source && source.sample !== usual) {
      void open({ ...fromSample(usual, null), insteadOf: sentence });
    } else {
      firstLoad.hide();
    }
  }
}

function fromSample(sample: Sample, view: Viewpoint | null): Source {
  const request: LoadRequest =
    sample.file === null
      ? { kind: "room", name: sample.label }
      : { kind: "sample", name: sample.label, url: new URL(sample.file, document.baseURI).href };
  return { request, sample, view, notes: [] };
}

function fromAddress(address: string, view: Viewpoint | null): Source {
  // What is no address is left as it is: downloading it fails in plain words.
  const url = URL.canParse(address, document.baseURI) ? new URL(address, document.baseURI) : null;
  const name = url?.pathname.split("/").pop() || address;
  return { request: { kind: "url", name, url: url?.href ?? address, skipNonFinite: false }, sample: null, view, notes: [] };
}

/** The same once more, where the points without a position were all that was wrong. */
function withoutNonFinite(error: unknown, source: Source): Source | null {
  const { request } = source;
  const possible = error instanceof LoadProblem && error.nonFinite > 0 && (request.kind === "file" || request.kind === "url");
  return possible ? { ...source, request: { ...request, skipNonFinite: true } } : null;
}

/** Scanners and surveyors have z up, modelers y. */
function usualUp(name: string): Up {
  return /\.(ply|obj)$/i.test(name) ? "y" : "z";
}

/** Reloading the page opens the same sample again. */
function rememberInAddress(sample: Sample): void {
  const address = new URL(location.href);
  address.searchParams.set("sample", sample.name);
  address.searchParams.delete("src");
  address.searchParams.delete("view");
  history.replaceState(null, "", address);
}

function plain(error: unknown): string {
  if (error instanceof HprError && error.code === "load") {
    return "a part of this page (its WebAssembly file or worker) could not be loaded; reload the page to try again";
  }
  if (error instanceof HprError && error.code === "too-large") return "it needs more memory than the browser gives to a page";
  return error instanceof Error ? error.message.replace(/\.$/, "") : String(error);
}
