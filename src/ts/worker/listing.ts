/** A set beside the clouds: their class is public, and this is not. */
const listing = new WeakSet<object>();

/**
 * From now on, the answers of a cloud have the indices of hidden points in memory, too (see
 * `hidden.ts`). For a cloud in one worker, of its own or shared.
 */
export function listHiddenToo(cloud: object): void {
  listing.add(cloud);
}

/** Whether the answers of a cloud list the hidden points, too. */
export function isListing(cloud: object | undefined): boolean {
  return cloud !== undefined && listing.has(cloud);
}
