import { AsyncLocalStorage } from "node:async_hooks";

type Stream = "stdout" | "stderr";

const collector = new AsyncLocalStorage<string[]>();

/** Shows text. Inside `collected`, keeps it instead. */
export function print(text: string | Buffer, stream: Stream = "stdout"): void {
  const parts = collector.getStore();
  if (parts === undefined) process[stream].write(text);
  else parts.push(text.toString());
}

/** Runs an action and collects its output in one piece, because other actions print at the same time. */
export async function collected<T>(action: () => Promise<T>): Promise<{ value: T; output: string }> {
  const parts: string[] = [];
  const value = await collector.run(parts, action);
  return { value, output: parts.join("") };
}
