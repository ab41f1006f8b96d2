// A file is dragged over the window: where may it be dropped? Anywhere.

import { element } from "../../parts/element";
import { toast } from "../../parts/toast";
import type { Store } from "../../store";
import { icon } from "../../style/icons";
import { take } from "./take";

export function mountDrop(store: Store): void {
  const veil = element("div", { class: "veil", aria: { hidden: "true" } },
    icon("open"), element("strong", {}, "Drop it anywhere"), element("span", {}, "A drawing or project opens; a picture, or the points of a scan, can be drawn over."));
  veil.hidden = true;
  document.body.append(veil);
  const isFile = (event: DragEvent): boolean => event.dataTransfer?.types.includes("Files") ?? false;
  addEventListener("dragover", (event) => {
    if (!isFile(event)) return;
    event.preventDefault();
    veil.hidden = false;
  });
  addEventListener("dragleave", (event) => { if (event.relatedTarget === null) veil.hidden = true; });
  addEventListener("drop", (event) => {
    veil.hidden = true;
    if (!isFile(event)) return;
    event.preventDefault();
    const [file, ...others] = event.dataTransfer?.files ?? [];
    if (!file) return;
    if (others.length > 0) toast(`Only ${file.name} was taken.`, { remedy: "Drop one file at a time." });
    void take(file, store);
  });
}
