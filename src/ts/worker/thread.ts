/** What a thread reports. After `died` it reports nothing more. */
export interface ThreadEvents {
  message(message: unknown): void;
  died(cause: unknown): void;
}

/** A worker of the browser or of Node, seen alike. */
export interface Thread {
  post(message: unknown, transfer: ArrayBuffer[]): void;
  /** While busy, Node's process does not end. */
  setBusy(busy: boolean): void;
  /** Ends the thread, which gives its memory back. Nothing is reported any more. */
  end(): Promise<void>;
}
