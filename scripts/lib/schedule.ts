/** One of several pieces of work that can run at the same time. */
export interface Job {
  title: string;
  /** Titles of the jobs that must have ended before this one begins. */
  needs?: string[];
  /** The name of a thing that no two jobs may use at once. */
  locks?: string;
}

/**
 * Runs jobs, as many at once as there are workers. A free worker takes the first job whose needs have
 * ended and whose lock nobody holds, so the order of the list is the order of preference.
 */
export async function inOrder<T extends Job>(
  jobs: T[],
  workers: number,
  run: (job: T) => Promise<void>,
): Promise<void> {
  const waiting = [...jobs];
  const pending = new Set(jobs.map(({ title }) => title));
  const locked = new Set<string>();
  let wake = (): void => undefined;
  let changed = newChange();

  function newChange(): Promise<void> {
    return new Promise((resolve) => (wake = resolve));
  }

  function isReady({ needs = [], locks }: T): boolean {
    return !needs.some((title) => pending.has(title)) && (locks === undefined || !locked.has(locks));
  }

  async function work(): Promise<void> {
    while (waiting.length > 0) {
      const index = waiting.findIndex(isReady);
      if (index < 0) {
        await changed;
        continue;
      }
      const [job] = waiting.splice(index, 1) as [T];
      if (job.locks !== undefined) locked.add(job.locks);
      await run(job);
      if (job.locks !== undefined) locked.delete(job.locks);
      pending.delete(job.title);
      wake();
      changed = newChange();
    }
  }

  await Promise.all(Array.from({ length: workers }, work));
}

/** The chosen jobs and every job that they need, directly or not. In the list a job comes after its needs. */
export function withNeeds<T extends Job>(jobs: T[], isChosen: (job: T) => boolean): T[] {
  const wanted = new Set<string>();
  for (const job of [...jobs].reverse()) {
    if (!isChosen(job) && !wanted.has(job.title)) continue;
    for (const title of [job.title, ...(job.needs ?? [])]) wanted.add(title);
  }
  return jobs.filter(({ title }) => wanted.has(title));
}
