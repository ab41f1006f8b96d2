// Under which name is the project kept? One that is there already is asked about, and never overwritten unasked.

import { button } from "../../parts/button";
import { dialog } from "../../parts/dialog";
import { element, freshId } from "../../parts/element";
import { toast } from "../../parts/toast";
import type { Store } from "../../store";
import { EXTENSION, projectName } from "./project_name";

export function saveProject(store: Store): () => void {
  const id = freshId("name");
  const field = element("input", { class: "field", id, testId: "save-name" });
  field.autocomplete = "off";
  field.spellcheck = false;
  field.maxLength = 120;
  const label = element("label", {}, "Name");
  label.htmlFor = id;
  const words = element("p", { class: "hint", role: "status" });
  let over = ""; // the name about which was asked
  let saving = false;
  const box = dialog({ title: "Save the project", testId: "save-dialog" });
  const go = button({ label: "Save", icon: "save", look: "primary", testId: "save-go", onPress: () => save() });
  const show = (text: string, wrong = false): void => {
    words.textContent = text;
    words.classList.toggle("wrong", wrong);
  };
  const usual = (): void => {
    over = "";
    go.querySelector("span")!.textContent = "Save";
    show(`In the folder “${store.known.welcome?.folder ?? ""}”. Drawing, edits and settings are in this one file.`);
  };
  const save = (): void => {
    const read = projectName(field.value);
    if ("wrong" in read) return show(read.wrong, true);
    const there = store.known.welcome?.files.includes(read.name) ?? false;
    if (there && over !== read.name && !isOwn(store, read.name)) {
      over = read.name;
      go.querySelector("span")!.textContent = "Replace";
      return show(`${read.name} is there already. Replace it?`, true);
    }
    saving = true;
    store.send({ type: "save", name: read.name, over: there });
  };
  field.addEventListener("input", usual);
  field.addEventListener("keydown", (event) => { if (event.key === "Enter") save(); });
  store.on("trouble", () => {
    const trouble = store.known.trouble;
    if (!saving || trouble?.about !== "file") return;
    saving = false;
    show(`${trouble.message} ${trouble.remedy}`, true);
  });
  store.on("saved", () => {
    if (!saving || !store.known.saved) return;
    saving = false;
    box.close();
    toast(`Saved as ${store.known.name ?? ""}.`);
  });
  box.body.append(element("div", { class: "name-row" }, label, element("span", { class: "with-unit" }, field, EXTENSION)), words);
  box.foot.append(button({ label: "Cancel", look: "quiet", onPress: box.close }), go);
  return () => {
    saving = false;
    field.value = (store.known.name ?? "my tree").replace(/\.[a-z]+$/i, "");
    usual();
    box.open();
    field.select();
  };
}

/** The file that this drawing was saved as before. */
function isOwn(store: Store, name: string): boolean {
  return store.known.name === name;
}
