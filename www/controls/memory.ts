/** Every name begins with this, because other pages of the same site store things, too. */
const OWN = "hidden-point-removal: ";

/** What this device has stored under a name. A browser may refuse to store anything. Then this is always `null`. */
export function remembered(name: string): string | null {
  try {
    return localStorage.getItem(OWN + name);
  } catch {
    return null;
  }
}

export function remember(name: string, value: string): void {
  try {
    localStorage.setItem(OWN + name, value);
  } catch {
    // See `remembered`.
  }
}
