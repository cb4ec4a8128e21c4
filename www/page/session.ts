import { HprError } from "hidden-point-removal";
import { Address, type CloudName } from "../settings/address.ts";
import { LoadProblem, type LoadRequest } from "../loaders/index.ts";
import { keepForOffline } from "../offline/keep.ts";
import { openCloud, type Place, requestFor, type Wish } from "../open/open-cloud.ts";
import { Controls } from "../panel/controls.ts";
import { byId } from "../controls/dom.ts";
import { FirstLoad } from "../panel/first-load.ts";
import { onFile } from "../panel/files.ts";
import type { Message } from "../panel/message.ts";
import { Progress } from "../panel/progress.ts";
import { SamplePicker } from "../panel/sample-picker.ts";
import type { Params } from "../settings/params.ts";
import { type Sample, sampleNamed } from "../samples/samples.ts";
import { Store, USUAL_SETTINGS } from "../settings/settings.ts";
import type { Status } from "./status.ts";
import type { AskedView } from "../view/framing.ts";
import { Workshop } from "../tools/workshop.ts";
import { LightHandles } from "../lights/handles.ts";
import { Viewer } from "../view/viewer.ts";

/** What is to be opened, and what the page has to know of it besides. */
interface Source extends Wish {
  /** How an address calls it. */
  name: CloudName | null;
  /** What the user has to know about it. */
  notes: string[];
  /** What could not be opened, so that this one is in its place. */
  insteadOf?: string;
}

/** From the address of the page to a cloud on screen, and from there to every other cloud the user opens. */
export function startSession(params: Params, status: Status, message: Message): void {
  const store = new Store({ ...USUAL_SETTINGS, ...params.settings, freeze: null, lights: USUAL_SETTINGS.lights });
  const viewer = new Viewer(byId("view", HTMLCanvasElement), store, params.embed);
  const controls = new Controls(viewer, store, { ...USUAL_SETTINGS, ...params.settings });
  const handles = new LightHandles(byId("lights"), viewer, store);
  const progress = new Progress(() => {
    stop();
  });
  const firstLoad = new FirstLoad();
  let loading = new AbortController();
  /** What is being loaded now. */
  let opening: Source | null = null;
  const limit = params.points === null ? {} : { limit: params.points };
  /** A view that was asked for stays in the address also where it is the first one. */
  let askedView: AskedView | null = null;
  const address: Address = new Address(
    store,
    () => {
      if (viewer.isHome && viewer.isTargetHome) return askedView && { view: askedView.at, target: askedView.target };
      return { view: viewer.viewpoint, target: viewer.target };
    },
    () => workshop.introducing,
  );

  const picker = new SamplePicker((sample) => {
    const source = fromSample(sample, null);
    if (source.name) address.choose(source.name);
    void open(source);
  });
  onFile({
    open: (file, notes) =>
      void open({
        request: { kind: "file", name: file.name, file, skipNonFinite: false, ...limit },
        sample: null,
        name: null,
        view: null,
        settings: {},
        notes,
      }),
    refuse: (sentence) => {
      message.show(sentence);
    },
  });

  let shownName = "";
  // Who comes without any wish of their own is shown what this is about.
  const workshop: Workshop = new Workshop(
    viewer,
    store,
    { name: () => shownName, link: () => address.link() },
    location.search === "",
  );
  viewer.onFrame = () => {
    handles.place();
    workshop.place();
  };
  viewer.stage.onCamera = () => {
    address.touch();
  };
  viewer.stage.onLost = () => {
    message.show(
      "The browser has taken the picture away to save memory; it is drawn again as soon as the browser allows, or when you reload the page.",
    );
  };
  viewer.stage.onRestored = () => {
    message.hide();
  };
  store.follow((now) => {
    status.describe(now.freeze !== null);
  });
  let note: string | null = null;
  const tell = (next: string | null) => {
    if (next !== null && next !== note) message.show(next);
    if (next === null && note !== null) message.hide();
    note = next;
  };
  viewer.onAnswer = (answer, total) => {
    controls.follow(answer);
    workshop.answer(answer);
    status.answer(answer, total, store.current.freeze !== null);
    tell(answer.note);
  };
  viewer.onLight = (light) => {
    status.lit(light?.question.lights.length ?? 0);
    if (light?.note) tell(light.note);
  };
  viewer.onAutomatic = (exponent) => {
    controls.markAutomatic(exponent);
    workshop.markAutomatic(exponent);
  };
  viewer.onBusy = (busy) => {
    status.busy(busy);
  };
  viewer.onError = (error) => {
    refuse(error, "The visible points could not be found");
  };
  const view = params.view && { at: params.view, target: params.target };
  const first =
    params.src === null ? fromSample(sampleNamed(params.sample), view) : fromAddress(params.src, view, limit);
  void open({ ...first, settings: params.settings, notes: params.notes });

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
    opening = source;
    say(`Loading ${request.name}.`);
    progress.show(null);
    try {
      const place: Place = {
        settings: () => store.current,
        aspect: () => viewer.stage.camera.aspect,
        asked: "in the address",
        shared: false,
        signal,
        onProgress: (step, fraction) => {
          say(step);
          progress.show(fraction);
        },
      };
      const ready = await openCloud(source, place);
      const more = [...ready.refusals, ...ready.notes];
      if (more.length > 0) message.show([...notes, ...more].join(" "));
      status.loaded();
      viewer.clear();
      store.change(ready.settings);
      askedView = ready.view;
      controls.prepare(ready.opened.cloud);
      workshop.clear();
      viewer.show(ready.opened);
      shownName = sample?.name ?? request.name;
      workshop.begin().catch(() => {
        message.show("The tools of this page could not be loaded; reload the page to try again.");
      });
      controls.usual = ready.usual;
      address.begin(insteadOf === undefined ? source.name : null, ready.usual);
      firstLoad.hide();
      if (insteadOf !== undefined) status.error(insteadOf);
      keepForOffline(request.kind === "sample" ? request.url : null);
      if (sample) picker.showSample(sample);
      else picker.showOwn(request.name);
    } catch (error) {
      if (signal.aborted) return;
      opening = null;
      progress.hide();
      refuse(error, `${request.name} could not be opened`, source);
      return;
    }
    opening = null;
    progress.hide();
  }

  /** Leaves what is being loaded; the cloud on screen stays. */
  function stop(): void {
    if (!opening) return;
    const source = opening;
    opening = null;
    loading.abort();
    progress.hide();
    refuse(new LoadProblem(`${source.request.name} was not opened: its loading was stopped.`), "", source);
  }

  function refuse(error: unknown, what: string, source?: Source): void {
    const sentence = error instanceof LoadProblem ? error.message : `${what}: ${plain(error)}.`;
    status.error(sentence);
    const again = source && withoutNonFinite(error, source);
    message.show(sentence, again ? [{ label: "Load without them", run: () => void open(again) }] : []);
    picker.restore();
    if (source) address.giveUp();
    // What a view is refused for goes with the next answer.
    else note = sentence;
    // Not to leave the page empty where nothing has been opened before.
    const usual = sampleNamed(params.sample);
    if (viewer.cloud === null && source && source.sample !== usual) {
      void open({ ...fromSample(usual, null), insteadOf: sentence });
    } else {
      firstLoad.hide();
    }
  }
}

function fromSample(sample: Sample, view: AskedView | null): Source {
  return {
    request: requestFor(sample, document.baseURI),
    sample,
    name: ["sample", sample.name],
    view,
    settings: {},
    notes: [],
  };
}

function fromAddress(address: string, view: AskedView | null, limit: { limit?: number }): Source {
  // What is no address is left as it is: downloading it fails in plain words.
  const url = URL.canParse(address, document.baseURI) ? new URL(address, document.baseURI) : null;
  const name = url?.pathname.split("/").pop() || address;
  const request: LoadRequest = { kind: "url", name, url: url?.href ?? address, skipNonFinite: false, ...limit };
  return { request, sample: null, name: ["src", address], view, settings: {}, notes: [] };
}

/** The same once more, where the points without a position were all that was wrong. */
function withoutNonFinite(error: unknown, source: Source): Source | null {
  const { request } = source;
  const possible =
    error instanceof LoadProblem && error.nonFinite > 0 && (request.kind === "file" || request.kind === "url");
  return possible ? { ...source, request: { ...request, skipNonFinite: true } } : null;
}

function plain(error: unknown): string {
  if (error instanceof HprError && error.code === "load") {
    return "a part of this page (its WebAssembly file or worker) could not be loaded; reload the page to try again";
  }
  if (error instanceof HprError && error.code === "too-large")
    return "it needs more memory than the browser gives to a page";
  return error instanceof Error ? error.message.replace(/\.$/, "") : String(error);
}
