// What is to be opened? A file of the folder the studio was started in, or any other by its upload.

import { button } from "../../parts/button";
import { dialog } from "../../parts/dialog";
import { element } from "../../parts/element";
import { icon } from "../../style/icons";
import type { Store } from "../../store";
import { roving } from "../roving";
import { EXTENSION } from "./project_name";
import { openCloudNamed } from "./open_cloud";
import { take } from "./take";
import { isCloud, isPicture, READABLE } from "./upload";

export function openFile(store: Store): () => void {
  const box = dialog({ title: "Open", testId: "open-dialog" });
  const where = element("p", { class: "hint" });
  const list = element("div", { class: "files", role: "group", aria: { label: "Files in the folder" } });
  const walk = roving(list, () => [...list.querySelectorAll<HTMLElement>("button")]);
  const picker = element("input", { class: "tick", testId: "open-file" });
  picker.type = "file";
  picker.accept = READABLE;
  picker.tabIndex = -1;
  picker.setAttribute("aria-label", "File to open");
  picker.addEventListener("change", () => {
    const file = picker.files?.[0];
    picker.value = ""; // the same file may be chosen again
    if (!file) return;
    box.close();
    void take(file, store);
  });
  const choose = button({ label: "Choose a file …", icon: "open", look: "primary", testId: "open-choose", onPress: () => picker.click() });
  const fill = (): void => {
    const welcome = store.known.welcome;
    const files = welcome?.files ?? [];
    const folder = `folder “${welcome?.folder ?? ""}”`;
    where.textContent = !welcome ? "Looking into the folder …" : files.length > 0
      ? `In the ${folder}, where the studio was started:`
      : `The ${folder} has no drawings yet. Choose a file, or drop one anywhere on the page.`;
    list.replaceChildren(...files.map((name) => file(name, name === `${store.known.name ?? ""}${EXTENSION}`, () => {
      box.close();
      if (isCloud(name)) openCloudNamed(name, store);
      else store.send({ type: "open", name });
    })));
    list.hidden = files.length === 0;
    walk.keep();
  };
  box.body.append(where, list, picker);
  box.foot.append(
    element("p", { class: "hint foot-words" }, "SVG, Excalidraw, InkML, sketch JSON, pictures, point clouds, projects. Undo brings back what is on the page now."),
    choose,
  );
  store.on(["welcome", "name"], () => { if (box.root.open) fill(); });
  return () => {
    fill();
    box.open();
    (list.querySelector("button") ?? choose).focus();
  };
}

function file(name: string, current: boolean, onPress: () => void): HTMLElement {
  const kind = icon(name.endsWith(EXTENSION) ? "leaf" : isPicture(name) ? "picture" : isCloud(name) ? "cloud" : "branch");
  const note = current ? element("span", { class: "file-note" }, "open now") : null;
  const made = element("button", { class: "file", title: `Open ${name}`, data: { name } }, kind, element("span", {}, name), note);
  made.type = "button";
  made.addEventListener("click", onPress);
  return made;
}
