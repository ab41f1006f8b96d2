// The tree as it is seen: a picture, or a film of it turning once. Whoever draws it makes them; here they are asked for and saved.

import { block, button } from "../../parts/button";
import { toast } from "../../parts/toast";
import { download } from "../download";

export interface Views {
  screenshot: () => Promise<Blob>; // PNG
  turntable: () => Promise<Blob>; // a film, or an archive of pictures where the browser makes no films
}

const ENDINGS: Record<string, string> = { "image/png": ".png", "video/webm": ".webm", "video/mp4": ".mp4", "application/zip": ".zip" };

export function pictureButton(views: Views, name: () => string): HTMLButtonElement {
  return viewButton("Screenshot", "camera", "screenshot", "A picture of the tree as you see it", () => views.screenshot(), name);
}

export function filmButton(views: Views, name: () => string): HTMLButtonElement {
  return viewButton("Turntable", "film", "turntable", "A film of the tree turning once; takes some seconds", () => views.turntable(), name);
}

function viewButton(label: string, icon: "camera" | "film", testId: string, hint: string, make: () => Promise<Blob>, name: () => string): HTMLButtonElement {
  const made = button({
    label, icon, hint, testId,
    onPress: () => {
      block(made, "working");
      make()
        .then((picture) => download(picture, name() + (ENDINGS[picture.type.split(";")[0]!] ?? "")))
        .catch(() => toast(`The ${label.toLowerCase()} could not be made.`, { remedy: "Is the tree on screen? Try again when it is.", kind: "wrong" }))
        .finally(() => block(made, null));
    },
  });
  return made;
}
