import type { Answers, Query, QueryKind } from "../query/queries.js";
import { asError, HprError } from "../base/errors.js";
import { abortError, reasonOf, whenAborted } from "./abort.js";
import { type GuestEvents, isProgress, READY, type Replies, type Reply, type Request } from "./protocol.js";
import { Team } from "./team.js";
import { startError } from "./start-thread.js";

type Kind = Request["kind"];

interface AskOptions {
  /** The request may be dropped before it starts, if a newer request with the same name arrives. */
  latest?: string | undefined;
  signal?: AbortSignal | undefined;
  /** Is told the share of the request that is done. */
  onProgress?: ((share: number) => void) | undefined;
  /** Is not garbage-collected while the request is pending. */
  owner?: object;
}

interface Pending extends AskOptions {
  request: Request;
  resolve: (value: unknown) => void;
  reject: (reason: unknown) => void;
  /** Stops the waiting for an abort. */
  forget?: () => void;
  /** Whether this was asked before, of workers that hung. */
  isAgain?: boolean;
}

/** The requests that make a cloud what it is. */
type Change = Extract<Request, { kind: "create" | "append" | "remove" }>;

/**
 * The requests to one team of workers. The team gets one request at a time. So a request that still
 * waits here can be dropped at no cost.
 */
export class RequestQueue implements GuestEvents {
  #team: Team | undefined;
  #workers: number | "shared" = 1;
  /** The changes that were made, so that the cloud can be made again. Undefined: it cannot. */
  #changes: Change[] | undefined;
  #ready = false;
  #running: Pending | undefined;
  #waiting: Pending[] = [];
  #closed: Error | undefined;

  /** `keeps`: whether it keeps a copy of all positions, to make the cloud again if its workers hang. */
  constructor(keeps: boolean) {
    this.#changes = keeps ? [] : undefined;
  }

  /** Starts this number of workers, or joins the shared worker. */
  async start(workers: number | "shared"): Promise<void> {
    this.#workers = workers;
    const team = await Team.start(workers, this);
    if (this.#closed !== undefined) {
      await team.end();
      throw this.#closed;
    }
    this.#team = team;
    this.#sendNext();
  }

  ask<K extends Kind>(request: Extract<Request, { kind: K }>, options: AskOptions = {}): Promise<Replies[K]> {
    return this.#send(request, options) as Promise<Replies[K]>;
  }

  query<K extends QueryKind>(query: Query<K>, options: AskOptions): Promise<Answers[K]> {
    return this.#send(query as Request, options) as Promise<Answers[K]>;
  }

  #send(request: Request, options: AskOptions): Promise<unknown> {
    return new Promise<unknown>((resolve, reject) => {
      if (this.#closed !== undefined) {
        reject(this.#closed);
        return;
      }
      // This request never waits, so it overtakes no other.
      if (options.signal?.aborted === true) {
        // oxlint-disable-next-line typescript/prefer-promise-reject-errors -- the caller's reason may be anything
        reject(reasonOf(options.signal));
        return;
      }
      if (options.latest !== undefined) {
        this.#dropOvertaken(options.latest);
      }
      this.#waiting.push({ ...options, request, resolve, reject });
      this.#sendNext();
    });
  }

  /** After `close`, throws its reason. */
  requireOpen(): void {
    if (this.#closed !== undefined) {
      throw this.#closed;
    }
  }

  /** Ends the workers. Pending and later requests are rejected with `reason`. */
  async close(reason: Error): Promise<void> {
    this.#closed = reason;
    this.#changes = undefined;
    const pending = this.#running === undefined ? this.#waiting : [this.#running, ...this.#waiting];
    this.#running?.forget?.();
    this.#running = undefined;
    this.#waiting = [];
    for (const { reject } of pending) {
      reject(reason);
    }
    const team = this.#team;
    this.#team = undefined;
    await team?.end();
  }

  message(message: unknown): void {
    if (isProgress(message)) {
      this.#running?.onProgress?.(message.progress);
      return;
    }
    if (message === READY) {
      this.#ready = true;
    } else {
      this.#settle(message as Reply);
    }
    this.#sendNext();
  }

  died(cause: unknown): void {
    const reason = cause instanceof Error ? cause.message : String(cause);
    void this.close(
      this.#ready
        ? new HprError("internal", `the worker died: ${reason}; create a new cloud to go on`, { cause })
        : startError(cause),
    );
  }

  /** Starts other workers, once, and asks the same again. */
  hung(): void {
    const [team, asked, changes] = [this.#team, this.#running, this.#changes];
    if (changes === undefined || asked?.isAgain === true) {
      void this.close(hungError());
      return;
    }
    this.#team = this.#running = undefined;
    this.#ready = false;
    void team?.end();
    this.#changes = [];
    const failed = (error: unknown) => {
      void this.close(asError(error));
    };
    const again = changes.map((request): Pending => ({
      request,
      isAgain: true,
      resolve: () => undefined,
      reject: failed,
    }));
    if (asked !== undefined) {
      asked.forget?.();
      again.push({ ...asked, isAgain: true });
    }
    this.#waiting.unshift(...again);
    this.start(this.#workers).catch(failed);
  }

  #settle(reply: Reply): void {
    const request = this.#running;
    this.#running = undefined;
    request?.forget?.();
    if ("abandoned" in reply) {
      request?.reject(request.signal ? reasonOf(request.signal) : abortError("the worker gave the request up"));
      return;
    }
    if ("value" in reply) {
      if (isChange(request?.request)) {
        this.#changes?.push(request.request);
      }
      request?.resolve(reply.value);
      return;
    }
    if ("thrown" in reply) {
      request?.reject(reply.thrown);
      return;
    }
    const error = new HprError(reply.error.code, reply.error.message);
    request?.reject(error);
    if (error.code === "internal") {
      // The worker's wasm instance is lost, and the cloud with it.
      void this.close(error);
    }
  }

  #sendNext(): void {
    if (this.#team === undefined || !this.#ready || this.#running !== undefined) {
      return;
    }
    let next: Pending | undefined;
    do {
      next = this.#waiting.shift();
    } while (next?.signal?.aborted === true);
    this.#running = next;
    this.#team.setBusy(next !== undefined);
    if (next !== undefined) {
      const { request, signal } = next;
      this.#team.post(
        request.kind === "visibleFrom" ? { ...request, sliced: signal !== undefined } : this.#toGive(request),
      );
      if (signal !== undefined) {
        next.forget = whenAborted(signal, () => {
          next.forget?.();
          this.#team?.abandon();
        });
      }
    }
  }

  /** The request as it is given away: its arrays are lost then. */
  #toGive(request: Request): Request {
    if (!isChange(request) || this.#changes === undefined) {
      return request;
    }
    try {
      return request.kind === "remove"
        ? { ...request, indices: request.indices.slice() }
        : { ...request, positions: request.positions.slice() };
    } catch {
      // There is no memory for a copy.
      this.#changes = undefined;
      return request;
    }
  }

  #dropOvertaken(by: string): void {
    const isOvertaken = ({ latest }: Pending) => latest === by;
    const overtaken = this.#waiting.filter(isOvertaken);
    this.#waiting = this.#waiting.filter((pending) => !isOvertaken(pending));
    for (const { reject } of overtaken) {
      reject(abortError("overtaken by a newer request"));
    }
  }
}

function isChange(request: Request | undefined): request is Change {
  return request?.kind === "create" || request?.kind === "append" || request?.kind === "remove";
}

/** The loss of workers that hang. Its cause tells it from other losses. */
function hungError(): HprError {
  const cause = new DOMException("the worker owed a reply for too long", "TimeoutError");
  const message = "the worker gave no sign of life for 20 seconds, although the page ran; create a new cloud to go on";
  return new HprError("internal", message, { cause });
}
