// A file was chosen or dropped: what becomes of it? A drawing or project opens; of a picture it is asked what it is for, of points how they are to be read.

import { toast } from "../../parts/toast";
import type { Store } from "../../store";
import { Refused } from "../ask";
import { openCloudFile } from "./open_cloud";
import { pictureDialog } from "./picture";
import { isCloud, isPicture, upload } from "./upload";

type Use = NonNullable<Parameters<typeof upload>[1]>;

const DONE: Record<Use, ((name: string) => string) | null> = {
  photo: null, // its card says it
  underlay: (name) => `${name} lies under the page: trace over it.`,
  cloud: (name) => `${name} lies behind the drawing.`,
  drawing: (name) => `${name} is open.`,
};

/** Take the file in; true where it is there now. Whatever goes wrong is told. */
export async function take(file: File, store: Store): Promise<boolean> {
  const as = isCloud(file.name) ? await openCloudFile(file, store) : await sent(file);
  if (as === null) return false;
  const words = DONE[as]?.(file.name);
  if (words) toast(words, { remedy: "Undo brings back what was there." });
  return true;
}

/** What it was sent as; null: not at all. */
async function sent(file: File): Promise<Use | null> {
  const as = isPicture(file.name) ? await pictureDialog(file) : "drawing";
  if (as === null) return null;
  try {
    await upload(file, as);
  } catch (error) {
    tell(error, file.name);
    return null;
  }
  return as;
}

function tell(error: unknown, name: string): void {
  if (error instanceof Refused) toast(error.message, { remedy: error.remedy, kind: "wrong" });
  else toast(`${name} could not be read.`, { remedy: "Try again; if it stays so, start the studio again.", kind: "wrong" });
}
