/** This set stands beside the clouds because their class is public and the set is not. */
const listing = new WeakSet<object>();

/**
 * From now on, the answers of a cloud also keep the indices of hidden points in memory (see
 * `hidden.ts`). The cloud must be in one worker, its own or the shared one.
 */
export function listHiddenToo(cloud: object): void {
  listing.add(cloud);
}

/** Whether the answers of a cloud also list the hidden points. */
export function isListing(cloud: object | undefined): boolean {
  return cloud !== undefined && listing.has(cloud);
}
