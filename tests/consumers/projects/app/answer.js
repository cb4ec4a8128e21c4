// Every consumer asks this question, in the page and in a worker. All answers must be equal.

/** Points on a sphere, every third one on a smaller sphere inside. */
export function positions() {
  const numbers = new Float32Array(3 * 3000);
  for (let i = 0; i < 3000; i++) {
    const radius = i % 3 === 0 ? 0.9 : 1;
    const z = 1 - (2 * i + 1) / 3000;
    const ring = Math.sqrt(1 - z * z);
    const turn = 2.399963 * i;
    numbers.set([radius * ring * Math.cos(turn), radius * ring * Math.sin(turn), radius * z], 3 * i);
  }
  return numbers;
}

export const viewpoint = [1, 2, 5];

/** @param input what `init` is given, if anything */
export async function answer(hpr, { WorkerPointCloud }, input) {
  const { here } = await answerHere(hpr, input);
  const remote = await WorkerPointCloud.create(positions(), { workers: 2 });
  const there = (await remote.visibleFrom(viewpoint)).indices;
  await remote.dispose();
  return { here, there: [...there] };
}

/** The same, after the entry `lite` has answered alike. */
export async function answerWithLite(hpr, worker, lite, input) {
  const answered = await answer(hpr, worker);
  const { here } = await answerHere(lite, input);
  if (String(here) !== String(answered.here)) throw new Error("the entry lite answers otherwise");
  return answered;
}

/** The same without a worker. */
export async function answerHere({ init, PointCloud }, input) {
  await init(input);
  const cloud = new PointCloud(positions());
  const here = [...cloud.visibleFrom(viewpoint).indices];
  cloud.dispose();
  return { here, there: here };
}
