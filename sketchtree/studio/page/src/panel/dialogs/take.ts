// A file was chosen or dropped: what becomes of it? A drawing or project opens; for a picture it is asked what it is for.

import { toast } from "../../parts/toast";
import { Refused } from "../ask";
import { pictureDialog } from "./picture";
import { isPicture, upload } from "./upload";

/** Take the file in; true where it is there now. Whatever goes wrong is told. */
export async function take(file: File): Promise<boolean> {
  const as = isPicture(file.name) ? await pictureDialog(file) : "drawing";
  if (as === null) return false;
  try {
    await upload(file, as);
  } catch (error) {
    tell(error, file.name);
    return false;
  }
  if (as !== "photo") toast(as === "underlay" ? `${file.name} lies under the page: trace over it.` : `${file.name} is open.`, { remedy: "Undo brings back what was there." });
  return true;
}

function tell(error: unknown, name: string): void {
  if (error instanceof Refused) toast(error.message, { remedy: error.remedy, kind: "wrong" });
  else toast(`${name} could not be read.`, { remedy: "Try again; if it stays so, start the studio again.", kind: "wrong" });
}
