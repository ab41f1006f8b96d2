// The matte as a picture that is as opaque as the tree is: what the program says, and over it what was painted since, in the same order.

import type { Matte, Stroke, Underlay } from "../../messages";
import type { PageCamera } from "../camera";
import { smooth } from "../paint/strokes";
import { layerLike } from "./layer";

/** Decoded; null: there is none, or it can't be read. */
export async function decoded(matte: Matte | null): Promise<ImageBitmap | null> {
  if (!matte?.png) return null;
  try {
    const bytes = Uint8Array.from(atob(matte.png), (letter) => letter.charCodeAt(0));
    return await createImageBitmap(new Blob([bytes], { type: "image/png" }));
  } catch {
    return null;
  }
}

export interface MaskLook {
  alone: boolean; // white on black in the photo's place
  colour: string; // of the tint
  strength: number; // of the tint, 0-1
}

/** Over the photo. Painting what is in the matte already changes nothing in it, so that all of it is painted again. */
export function paintMask(
  on: CanvasRenderingContext2D, ratio: number, camera: PageCamera, underlay: Underlay, mask: CanvasImageSource, painted: readonly Stroke[], look: MaskLook,
): void {
  const layer = layerLike(on);
  if (!layer) return;
  const [left, top] = camera.toScreen(underlay.x, underlay.y);
  const [width, height] = [underlay.width * camera.scale, underlay.height * camera.scale];
  layer.setTransform(ratio, 0, 0, ratio, 0, 0);
  layer.save();
  layer.beginPath();
  layer.rect(left, top, width, height);
  layer.clip();
  layer.drawImage(mask, left, top, width, height);
  layer.setTransform(ratio * camera.scale, 0, 0, ratio * camera.scale, ratio * camera.x, ratio * camera.y);
  layer.strokeStyle = "#fff";
  for (const stroke of painted) {
    layer.globalCompositeOperation = stroke.kind === "matte_add" ? "source-over" : "destination-out";
    layer.lineWidth = stroke.width ?? 1;
    layer.stroke(smooth(stroke.xy, false));
  }
  layer.restore();
  layer.setTransform(1, 0, 0, 1, 0, 0);
  layer.globalCompositeOperation = "source-in";
  layer.fillStyle = look.alone ? "#fff" : look.colour;
  layer.fillRect(0, 0, layer.canvas.width, layer.canvas.height);
  layer.globalCompositeOperation = "source-over";
  on.save();
  if (look.alone) {
    on.fillStyle = "#000";
    on.fillRect(left, top, width, height);
  } else on.globalAlpha = look.strength;
  on.setTransform(1, 0, 0, 1, 0, 0);
  on.drawImage(layer.canvas, 0, 0);
  on.restore();
}
