// How does a file of the user's come to the program? Whole, by its name; the program knows by its content what it is.

import { MAX_UPLOAD, type CloudReading } from "../../messages";
import { ask, Refused } from "../ask";
import { bytes } from "../figures";

/** What the program reads; a picture may also be traced over. */
export const READABLE = ".sketchtree,.svg,.svgz,.json,.excalidraw,.excalidrawlib,.inkml,.ndjson,.png,.jpg,.jpeg,.webp,.tif,.tiff,.gif,.bmp,.ply,.las,.laz,.xyz,.txt,.csv,.pts,.asc,.npz,.npy";
const CLOUDS = /\.(ply|las|laz|xyz|txt|csv|pts|asc|npz|npy)$/i;
const PICTURES = /\.(png|jpe?g|webp|tiff?|gif|bmp)$/i;

export function isPicture(name: string): boolean {
  return PICTURES.test(name);
}

export function isCloud(name: string): boolean {
  return CLOUDS.test(name);
}

/** `photo`: a tree is marked in it, on a page of its own; `underlay`: to trace over; `drawing`: strokes are read from it, or points on a page of their own; `cloud`: points behind
 *  the drawing; `reading`: how the points are to be read. Raises `Refused`. */
export async function upload(file: File, as: "photo" | "underlay" | "drawing" | "cloud", reading: CloudReading = {}): Promise<void> {
  const tooLarge = `${file.name} has ${bytes(file.size)}; at most ${bytes(MAX_UPLOAD)} can be read.`;
  if (file.size > MAX_UPLOAD) throw new Refused(tooLarge, "Save it smaller, or with less in it.");
  if (file.size === 0) throw new Refused(`${file.name} is empty.`, "Choose another file.");
  const query = new URLSearchParams({ name: file.name });
  if (isPicture(file.name) || isCloud(file.name)) query.set("as", as);
  for (const [name, value] of Object.entries(reading)) if (value != null) query.set(name, String(value));
  await ask(`upload?${query.toString()}`, { method: "POST", body: file });
}
