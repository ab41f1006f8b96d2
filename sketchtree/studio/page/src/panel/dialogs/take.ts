// A file was chosen or dropped: what becomes of it? A drawing or project opens; for a picture, and for points where there is a drawing, it is asked what they are for.

import { toast } from "../../parts/toast";
import type { Store } from "../../store";
import { Refused } from "../ask";
import { cloudDialog, treeDialog } from "./cloud";
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
  const as = await use(file, store);
  if (as === null) return false;
  try {
    if (!(await sent(file, as))) return false;
  } catch (error) {
    tell(error, file.name);
    return false;
  }
  const words = DONE[as]?.(file.name);
  if (words) toast(words, { remedy: "Undo brings back what was there." });
  return true;
}

async function use(file: File, store: Store): Promise<Use | null> {
  if (isPicture(file.name)) return pictureDialog(file);
  return isCloud(file.name) && store.known.strokes.size > 0 && !store.known.underlay?.photo ? cloudDialog() : "drawing";
}

/** False: several trees stand in it, and none was chosen. */
async function sent(file: File, as: Use): Promise<boolean> {
  try {
    await upload(file, as);
  } catch (error) {
    if (!(error instanceof Refused) || error.trees.length === 0) throw error;
    const tree = await treeDialog(file.name, error.trees);
    if (tree === null) return false;
    await upload(file, as, tree);
  }
  return true;
}

function tell(error: unknown, name: string): void {
  if (error instanceof Refused) toast(error.message, { remedy: error.remedy, kind: "wrong" });
  else toast(`${name} could not be read.`, { remedy: "Try again; if it stays so, start the studio again.", kind: "wrong" });
}
