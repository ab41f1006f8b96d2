// A picture: is it to be traced over, or do its lines become strokes?

import { button } from "../../parts/button";
import { dialog } from "../../parts/dialog";
import { element } from "../../parts/element";

export type PictureUse = "photo" | "underlay" | "drawing";

const PHOTO = "It shows a tree: outline the crown and mark a few branches; or, where it is bare, scribble on it and beside it.";
const TRACE = "It lies faintly under the page, and you draw the branches yourself. For sketches and pictures of any kind.";
const READ = "Dark lines on light paper become strokes. For line drawings, scans and pencil pages.";

/** Ask; `null`: neither. */
export function pictureDialog(file: File): Promise<PictureUse | null> {
  return new Promise((resolve) => {
    let answer: PictureUse | null = null;
    const address = URL.createObjectURL(file);
    const box = dialog({
      title: "What is this picture for?", testId: "picture-dialog",
      onClose: () => {
        URL.revokeObjectURL(address);
        box.root.remove();
        resolve(answer);
      },
    });
    const choose = (use: PictureUse): void => {
      answer = use;
      box.close();
    };
    const shown = element("img", { class: "picture-shown" });
    shown.alt = file.name;
    shown.src = address;
    shown.addEventListener("error", () => shown.remove());
    box.body.append(
      shown,
      element("div", { class: "ways" },
        way("A tree from a photo", PHOTO, "picture-photo", () => choose("photo")),
        way("Trace over it", TRACE, "picture-underlay", () => choose("underlay")),
        way("Read its lines", READ, "picture-drawing", () => choose("drawing"))),
    );
    box.foot.append(button({ label: "Cancel", look: "quiet", onPress: box.close }));
    box.open();
  });
}

function way(title: string, text: string, testId: string, onPress: () => void): HTMLElement {
  const made = element("button", { class: "way", testId }, element("strong", {}, title), element("span", {}, text));
  made.type = "button";
  made.addEventListener("click", onPress);
  return made;
}
