import { viewOf } from "../ask/question.ts";
import { measuredBy } from "../open/stations.ts";
import type { Message } from "../panel/message.ts";
import type { Settings } from "../settings/settings.ts";
import type { Store } from "../settings/store.ts";
import type { Opened, Viewer } from "../view/viewer.ts";
import { sentenceOf } from "./notices.ts";

interface Parts {
  viewer: Viewer;
  store: Store;
  message: Message;
}

/**
 * Takes the smallest thickness at which the stations of the file see the points that they measured, and says which share of
 * these they see. Looks are needed for that.
 */
export async function calibrate(opened: Opened, { viewer, store, message }: Parts): Promise<void> {
  const { cloud, inquiry } = opened;
  const measured = measuredBy(opened);
  message.show("Looking from its stations.");
  const before = store.current;
  const looking = {
    radius: { rule: "auto" },
    inversion: "spherical",
    looks: before.looks || 3,
  } satisfies Partial<Settings>;
  const [{ viewpoint }] = measured as [(typeof measured)[number]];
  try {
    const { method } = viewOf(viewpoint, { ...before, ...looking, thickness: "auto" });
    const { thickness, recall } = await inquiry.cloud.points.calibrate(measured, inquiry.cloud.options(method));
    if (viewer.cloud !== cloud) return;
    store.change({ ...looking, thickness });
    const seen = recall.reduce((sum, share, i) => sum + share * measured[i]!.indices.length, 0);
    const all = measured.reduce((sum, { indices }) => sum + indices.length, 0);
    const whose = measured.length === 1 ? ["scan’s", "its station"] : ["scans’", "their stations"];
    message.show(
      `${Math.floor((100 * seen) / all)}\u00a0% of the ${whose[0]} own points can be seen from ${whose[1]}.`,
      [
        {
          label: "Undo",
          run: () => {
            const { radius, inversion, looks: own, thickness: usual } = before;
            store.change({ radius, inversion, looks: own, thickness: usual });
          },
        },
      ],
    );
  } catch (error) {
    if (viewer.cloud === cloud) message.show(sentenceOf(error, "The stations could not be asked"));
  }
}
