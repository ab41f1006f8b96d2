// Points of a file of the user's, or of the folder, are opened once it was asked how: the dialog, and what the program is asked then.

import type { CloudReading } from "../../messages";
import type { Store } from "../../store";
import { Refused } from "../ask";
import { cloudDialog, type CloudUse } from "./cloud";
import { upload } from "./upload";

/** A file that was chosen or dropped; what became of it, null: nothing. */
export function openCloudFile(file: File, store: Store): Promise<CloudUse | null> {
  const drawn = store.known.strokes.size > 0 && !store.known.underlay?.photo;
  return cloudDialog({ name: file.name, drawn, read: (use, reading) => upload(file, use, reading) });
}

/** One of the folder, on a page of its own. */
export function openCloudNamed(name: string, store: Store): void {
  void cloudDialog({ name, drawn: false, read: (_, cloud) => opened(name, cloud, store) });
}

/** Opened by the program; what it says next tells how it went. */
function opened(name: string, cloud: CloudReading, store: Store): Promise<void> {
  return new Promise((resolve, reject) => {
    const ends = [
      store.on("changed", () => end(resolve)),
      store.on("trouble", () => {
        const { trouble } = store.known;
        if (trouble?.about !== "file") return;
        store.known.trouble = null; // it is told in the dialog
        store.tell("trouble");
        end(() => reject(new Refused(trouble.message, trouble.remedy)));
      }),
      store.on("several", () => {
        const { several } = store.known;
        if (several?.name === name) end(() => reject(new Refused(`Several trees stand in ${name}.`, "Choose one of them.", several.trees)));
      }),
    ];
    const end = (then: () => void): void => {
      ends.forEach((stop) => stop());
      then();
    };
    store.send({ type: "open", name, cloud });
  });
}
