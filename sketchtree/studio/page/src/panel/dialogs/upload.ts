// How does a file of the user's come to the program? Whole, by its name; the program knows by its content what it is.

import { MAX_UPLOAD } from "../../messages";
import { ask, Refused } from "../ask";
import { bytes } from "../figures";

/** What the program reads; a picture may also be traced over. */
export const READABLE = ".sketchtree,.svg,.svgz,.json,.excalidraw,.excalidrawlib,.inkml,.ndjson,.png,.jpg,.jpeg,.webp,.tif,.tiff,.gif,.bmp";
const PICTURES = /\.(png|jpe?g|webp|tiff?|gif|bmp)$/i;

export function isPicture(name: string): boolean {
  return PICTURES.test(name);
}

/** `photo`: a tree is marked in it, on a page of its own; `underlay`: to trace over; `drawing`: strokes are read from it. Raises `Refused`. */
export async function upload(file: File, as: "photo" | "underlay" | "drawing"): Promise<void> {
  const tooLarge = `${file.name} has ${bytes(file.size)}; at most ${bytes(MAX_UPLOAD)} can be read.`;
  if (file.size > MAX_UPLOAD) throw new Refused(tooLarge, "Save it smaller, or with less in it.");
  if (file.size === 0) throw new Refused(`${file.name} is empty.`, "Choose another file.");
  const query = new URLSearchParams({ name: file.name });
  if (isPicture(file.name)) query.set("as", as);
  await ask(`upload?${query.toString()}`, { method: "POST", body: file });
}
