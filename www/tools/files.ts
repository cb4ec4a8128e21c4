/** Points written at once: not for longer than a frame takes. */
export const BATCH = 8192;

/** Puts pieces together to a file that the browser saves. Between the pieces the page goes on drawing. */
export async function save(name: string, parts: Iterable<BlobPart>): Promise<void> {
  const done: Blob[] = [];
  for (const part of parts) {
    // Each by itself: text is encoded here, and megabytes of it at the end would hold the page up.
    done.push(new Blob([part]));
    await new Promise((resolve) => setTimeout(resolve));
  }
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob(done));
  link.download = name;
  link.click();
  // The browser has begun to read it by then.
  setTimeout(() => {
    URL.revokeObjectURL(link.href);
  }, 60_000);
}

/** Whether the browser lets the page copy: not without a secure connection, nor where the user forbids it. */
export async function copy(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return false;
  }
}
