/**
 * Lets a class take part in `using`, on platforms that have it. On others, `Symbol.dispose` is
 * undefined, and a method written with that name would be called "undefined".
 */
export function addDisposeSymbol(prototype: { dispose(): unknown }): void {
  const { dispose } = Symbol as { dispose?: symbol };
  if (dispose !== undefined) {
    Object.defineProperty(prototype, dispose, {
      value(this: { dispose(): unknown }) {
        this.dispose();
      },
      configurable: true,
      writable: true,
    });
  }
}
