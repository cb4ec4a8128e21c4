import { WorkerPointCloud } from "hidden-point-removal/worker";
import { type Detail, Inquiry, type TimedView } from "../ask/inquiry.ts";
import { WorkerCloud } from "../ask/worker-cloud.ts";
import type { Cloud } from "../cloud/cloud.ts";
import { spacingOf } from "../cloud/spacing.ts";
import type { Settings, Viewpoint } from "../settings/settings.ts";
import type { StreamStep } from "./protocol.ts";

/** The overview's inquiry: it notes when the camera or the settings have changed. */
type Leader = Pick<Inquiry, "follow" | "busy">;

/** Answers the tools' questions about the points of a view. The picture's questions go to the overview. */
class DetailInquiry extends Inquiry {
  readonly #leader: Leader;

  constructor(cloud: WorkerCloud, another: () => Promise<WorkerCloud>, size: number, leader: Leader) {
    super(cloud, another, size);
    this.#leader = leader;
  }

  override get busy(): boolean {
    return this.#leader.busy;
  }

  override follow(viewpoint: Viewpoint, settings: Settings): void {
    this.#leader.follow(viewpoint, settings);
  }
}

/** Makes a cloud of the points of a step. All of them are visible together, as they are in the whole octree. */
export async function detailOf(
  { positions, colors, exact, points, merge }: StreamStep,
  viewpoint: Viewpoint,
  overview: Cloud,
  leader: Leader,
  { total, sentence, ...said }: Pick<TimedView, "kind" | "asked" | "question"> & NonNullable<TimedView["whole"]>,
): Promise<Detail> {
  const { center, size, radius, body, facts } = overview;
  const [x, y, z] = body?.size ?? size;
  const local = new Float32Array(positions.length);
  for (let i = 0; i < positions.length; i++) local[i] = positions[i]! - center[i % 3]!;
  const cloud: Cloud = {
    count: positions.length / 3,
    colors,
    attributes: [],
    fields: [],
    // These points are not those of the file's records.
    facts: { ...(facts.decimals && { decimals: facts.decimals }), ...(facts.crs && { crs: facts.crs }) },
    origin: null,
    center,
    local,
    size,
    radius,
    body,
    spacing: spacingOf(local, Math.sqrt((2 * (x * y + y * z + z * x)) / (exact ? total : points))),
  };
  const made = async () => new WorkerCloud(await WorkerPointCloud.create(positions, { workers: 1 }), center);
  const worker = await made();
  const inquiry = new DetailInquiry(worker, made, radius, leader);
  try {
    const visibility = await worker.points.visibleFrom(viewpoint, merge);
    const milliseconds = performance.now() - said.asked;
    const whole = { total, sentence };
    const answer = { ...said, whole, visibility, note: null, milliseconds };
    return { cloud, positions, inquiry, answer };
  } catch (error) {
    inquiry.dispose();
    throw error;
  }
}
