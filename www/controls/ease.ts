/** A share of the way that begins and ends slowly, after a share of the time. */
export function eased(share: number): number {
  return share * share * (3 - 2 * share);
}
