/** Asks one question at a time. Of those that come up meanwhile only the newest is asked, so that answers keep up with the camera. */
export class Newest<Question> {
  private readonly ask: (question: Question) => Promise<void>;
  private asking = false;
  private next: { question: Question } | null = null;

  /** `ask` deals with its answer and with its errors. */
  constructor(ask: (question: Question) => Promise<void>) {
    this.ask = ask;
  }

  want(question: Question): void {
    this.next = { question };
    if (!this.asking) void this.run();
  }

  private async run(): Promise<void> {
    this.asking = true;
    while (this.next) {
      const { question } = this.next;
      this.next = null;
      await this.ask(question);
    }
    this.asking = false;
  }
}
