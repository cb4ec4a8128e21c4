import type { Stage } from "../view/stage.ts";

/** The picture and the marks over it, as a PNG file. */
export async function pictureWithMarks(stage: Stage, marks: SVGSVGElement): Promise<Blob> {
  const picture = await createImageBitmap(await stage.snapshot());
  const canvas = new OffscreenCanvas(picture.width, picture.height);
  const context = canvas.getContext("2d")!;
  context.drawImage(picture, 0, 0);
  context.drawImage(await imageOf(marks, stage.size), 0, 0, picture.width, picture.height);
  return canvas.convertToBlob({ type: "image/png" });
}

/** Makes an image of the SVG. It contains its own style. It needs only its size to stand alone. */
async function imageOf(
  svg: SVGSVGElement,
  { width, height }: { width: number; height: number },
): Promise<HTMLImageElement> {
  const alone = svg.cloneNode(true) as SVGSVGElement;
  alone.setAttribute("width", String(width));
  alone.setAttribute("height", String(height));
  const image = new Image();
  image.src = `data:image/svg+xml,${encodeURIComponent(new XMLSerializer().serializeToString(alone))}`;
  await image.decode();
  return image;
}
