import { LoadProblem, type ReadOptions } from "../loaders/index.ts";
import { openCloud } from "../open/open-cloud.ts";
import { type Message, Progress } from "../panel/message.ts";
import type { Panel } from "../panel/panel.ts";
import { SamplePicker } from "../panel/sample-picker.ts";
import type { Sample } from "../samples/samples.ts";
import type { Address, Usual } from "../settings/address.ts";
import type { Up } from "../cloud/cloud.ts";
import { canLook, type Store, USUAL_SETTINGS } from "../settings/settings.ts";
import type { Workshop } from "../tools/workshop.ts";
import type { AskedView } from "../view/framing.ts";
import type { Viewer } from "../view/viewer.ts";
import { chooseColumns, isLoss, type Notices, sentenceOf } from "./notices.ts";
import { fromSample, nameOf, type Source } from "./sources.ts";
import type { Status } from "./status.ts";

/** The sides that may be up, in the order in which they are tried. */
const UPS: readonly Up[] = ["z", "y", "-y"];

/** The parts of the page that take part when a cloud is opened. */
export interface PageParts {
  viewer: Viewer;
  store: Store;
  panel: Panel;
  address: Address;
  workshop: Workshop;
  status: Status;
  message: Message;
  notices: Notices;
}

/** Opens one cloud after another. The cloud on screen stays until the next one has its first answer. */
export class Opening {
  /** The name of the cloud on screen, for use in a sentence. */
  shownName = "";
  /** The settings that the cloud on screen has if nothing else is asked for. */
  usual: Usual = USUAL_SETTINGS;
  /** Called when a cloud is about to be opened. */
  onOpen: (source: Source) => void = () => undefined;
  /** The view that was asked for. It stays in the address although it is the first view. */
  askedView: AskedView | null = null;
  readonly #parts: PageParts;
  readonly #usual: Sample;
  readonly #picker: SamplePicker;
  readonly #progress = new Progress(() => this.#stop());
  #loading = new AbortController();
  /** The cloud that is being loaded. */
  #source: Source | null = null;
  #shown: Source | null = null;

  /** `usual`: the sample that replaces a first cloud that cannot be opened. */
  constructor(parts: PageParts, usual: Sample) {
    this.#parts = parts;
    this.#usual = usual;
    const turnUp = () => {
      const { up } = parts.store.current;
      parts.store.change({ up: UPS[(UPS.indexOf(up) + 1) % UPS.length]!, freeze: null });
    };
    this.#picker = new SamplePicker((sample) => {
      const source = fromSample(sample);
      if (source.name) parts.address.choose(source.name);
      void this.open(source);
    }, turnUp);
  }

  /** The cloud on screen. */
  get source(): Source | null {
    return this.#shown;
  }

  /** Says what the looks take the cloud to be. */
  say(): void {
    const { viewer, store, status } = this.#parts;
    if (!viewer.cloud || !canLook(store.current) || store.current.looks === 0) return;
    const { inquiry, cloud } = viewer.scene;
    // A cloud that is put away meanwhile says nothing.
    status.surface(inquiry.cloud, cloud, () => store.current).catch(() => undefined);
  }

  /** Gives up a cloud that is being loaded, and loads this one. */
  async open(source: Source): Promise<void> {
    this.onOpen(source);
    this.#loading.abort();
    const { signal } = (this.#loading = new AbortController());
    this.#source = source;
    this.#begin(source);
    try {
      await this.#show(source, signal);
    } catch (error) {
      if (signal.aborted) return;
      this.#end();
      this.#refuse(error, source);
      return;
    }
    this.#end();
  }

  #begin(source: Source): void {
    const { message } = this.#parts;
    if (source.notes.length > 0) message.show(source.notes.join(" "));
    // The sentence about the cloud that could not be opened stays until the user does something else.
    else if (source.insteadOf === undefined) message.hide();
    if (source.insteadOf === undefined) this.#parts.status.loading(`Loading ${source.request.name}.`);
    this.#progress.show(null);
  }

  async #show(source: Source, signal: AbortSignal): Promise<void> {
    const { viewer, store, panel, address, workshop, status, message } = this.#parts;
    const { request, sample, name, notes, insteadOf } = source;
    const ready = await openCloud(source, {
      settings: () => store.current,
      shape: () => {
        // The observer of the verbs may be called later.
        viewer.stage.refit();
        return viewer.stage.shape;
      },
      asked: "in the address",
      // The worker that has been started ahead.
      shared: viewer.cloud === null,
      signal,
      onProgress: (step, fraction) => {
        if (insteadOf === undefined) status.loading(step);
        this.#progress.show(fraction);
      },
      onHanded: () => {
        if (viewer.cloud === null) viewer.warmUp();
      },
    });
    const more = [...ready.refusals, ...ready.notes];
    const { home, cloud } = ready.opened;
    const actions = [];
    if (cloud.body && home.extent.radius < cloud.radius) {
      more.push("A few points lie far away from all others, and are not in the picture.");
      actions.push({
        label: "Show all",
        run: () => viewer.setHome(ready.homeFrom(null, true)),
      });
    }
    if (ready.columnsAt) {
      const { columnsAt } = ready;
      actions.push({
        label: "Choose columns",
        run: () => {
          chooseColumns(columnsAt, (chosen) => {
            const chosenRequest = asked(source, { chosen });
            if (chosenRequest) void this.open({ ...source, request: chosenRequest });
          });
        },
      });
    }
    if (more.length > 0) message.show([...notes, ...more].join(" "), actions);
    status.loaded();
    viewer.clear();
    store.change(ready.settings);
    this.askedView = ready.view;
    panel.prepare(ready.opened.cloud);
    workshop.clear();
    viewer.show(ready.opened);
    // A file that could not be read is not open. The first column of several files is that of their names.
    const read = request.kind === "files" ? Object.values(cloud.fields[0]!.labels!) : [request.name];
    this.shownName = sample?.name ?? nameOf(read);
    this.#shown = source;
    workshop.begin(source.marks ?? null).then(
      (said) => {
        if (said !== null) message.show(said);
      },
      () => {
        message.show("The tools of this page could not be loaded; reload the page to try again.");
      },
    );
    panel.usual = this.usual = ready.usual;
    address.begin(insteadOf === undefined ? name : null, ready.usual);
    if (insteadOf !== undefined) status.error(insteadOf);
    this.say();
    if (sample) this.#picker.showSample(sample);
    else this.#picker.showOwn(this.shownName);
  }

  #end(): void {
    this.#source = null;
    this.#progress.hide();
  }

  /** Gives up the cloud that is being loaded; the one on screen stays. */
  #stop(): void {
    const source = this.#source;
    if (!source) return;
    this.#loading.abort();
    this.#end();
    this.#refuse(new LoadProblem(`${source.request.name} was not opened: its loading was stopped.`), source);
  }

  #refuse(error: unknown, source: Source): void {
    const { notices, address, viewer } = this.#parts;
    const sentence = sentenceOf(error, `${source.request.name} could not be opened`);
    const actions = [];
    const rest = error instanceof LoadProblem ? error.rest : undefined;
    const request = rest && asked(source, rest.with);
    if (request) actions.push({ label: `Load ${rest.words}`, run: () => void this.open({ ...source, request }) });
    if (isLoss(error)) actions.push({ label: "Restart", run: () => void this.open(source) });
    notices.error(sentence, actions);
    this.#picker.restore();
    address.giveUp();
    // The page does not stay empty.
    if (viewer.cloud === null && source.sample !== this.#usual) {
      void this.open({ ...fromSample(this.#usual), insteadOf: sentence });
    }
  }
}

/** The request with other options. `undefined`: it is not for one file. */
function asked({ request }: Source, options: ReadOptions): Source["request"] | undefined {
  return request.kind === "file" || request.kind === "url" ? { ...request, ...options } : undefined;
}
