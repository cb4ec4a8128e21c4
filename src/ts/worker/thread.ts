/** What a thread reports. After `died` or `hung` it reports nothing more. */
export interface ThreadEvents {
  message(message: unknown): void;
  died(cause: unknown): void;
}

/** What the user of a thread hears besides. */
export interface GuestEvents extends ThreadEvents {
  /** The thread owes a reply and has given no sign of life for long. It is ended. */
  hung(): void;
}

/** A worker of the browser or of Node, behind one interface. */
export interface Thread {
  post(message: unknown, transfer: ArrayBuffer[]): void;
  /** While the thread is busy, Node's process does not end. */
  setBusy(busy: boolean): void;
  /** Ends the thread, which frees its memory. After that, nothing is reported. */
  end(): Promise<void>;
}
