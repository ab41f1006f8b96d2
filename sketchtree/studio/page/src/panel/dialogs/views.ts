// The tree as it is seen: a picture, or a film of it turning once. Whoever draws it makes them; here they are asked for and saved.

import { block, button } from "../../parts/button";
import { Refused } from "../ask";
import { download } from "../download";

export interface Views {
  screenshot: () => Promise<Blob>; // PNG
  turntable: () => Promise<Blob>; // a film, or an archive of pictures where the browser makes no films
}

export interface ViewLook {
  views: Views;
  name: () => string; // of the file, without its ending
  started: () => void;
  failed: (error: Refused) => void;
}

const ENDINGS: Record<string, string> = { "image/png": ".png", "video/webm": ".webm", "video/mp4": ".mp4", "application/zip": ".zip" };

export function pictureButton(look: ViewLook): HTMLButtonElement {
  return viewButton(look, "Screenshot", "camera", "A picture of the tree as you see it", () => look.views.screenshot());
}

export function filmButton(look: ViewLook): HTMLButtonElement {
  return viewButton(look, "Turntable", "film", "A film of the tree turning once; takes some seconds", () => look.views.turntable());
}

function viewButton(look: ViewLook, label: string, icon: "camera" | "film", hint: string, make: () => Promise<Blob>): HTMLButtonElement {
  const word = (text: string): void => { made.querySelector("span")!.textContent = text; };
  const made = button({
    label, icon, hint, testId: label.toLowerCase(),
    onPress: () => {
      look.started();
      block(made, "working");
      word("Working …");
      make()
        .then((picture) => download(picture, look.name() + (ENDINGS[picture.type.split(";")[0]!] ?? "")))
        .catch(() => look.failed(new Refused(`The ${label.toLowerCase()} could not be made.`, "Is the tree on screen? Try again when it is.")))
        .finally(() => {
          block(made, null);
          word(label);
        });
    },
  });
  return made;
}
