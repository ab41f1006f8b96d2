// What was done to the tree by hand? Each can be looked at, and taken back alone; nothing else ever does.

import type { Edit } from "../../messages";
import { button } from "../../parts/button";
import { element } from "../../parts/element";
import { icon, type IconName } from "../../style/icons";
import type { Store } from "../../store";
import { editWords } from "./words";

const ICONS: Record<Edit["what"], IconName> = { held: "pin", cleared: "scissors", adopted: "branch" };
const NOTHING = "Nothing yet. Select a branch in the tree (V): drag its dots, flip it (F), lock it (L) or delete it. Whatever else you change, it stays so.";

export function editsList(store: Store, mark: (text: string) => void): HTMLElement {
  const list = element("ul", { class: "edits", testId: "edits" });
  const empty = element("p", { class: "hint" }, NOTHING);
  const fill = (): void => {
    const { edits, limbs, strokes } = store.known;
    const order = edits.length > 0 ? [...strokes.keys()] : [];
    list.replaceChildren(...edits.map((edit) => entry(store, edit, editWords(edit, limbs, order))));
    empty.hidden = edits.length > 0;
    list.hidden = edits.length === 0;
    mark(edits.length > 0 ? String(edits.length) : "");
    select();
  };
  const select = (): void => {
    for (const one of list.querySelectorAll("li")) one.classList.toggle("selected", one.dataset["limb"] === store.ui.selected);
  };
  store.on(["edits", "limbs", "strokes"], fill);
  store.on("selected", select);
  fill();
  return element("div", {}, empty, list);
}

function entry(store: Store, edit: Edit, words: ReturnType<typeof editWords>): HTMLElement {
  const label = [icon(ICONS[edit.what]), element("span", {}, words.what), element("span", { class: "where" }, words.where)];
  const seen = edit.what !== "cleared"; // what was removed can't be selected
  const show = element("button", { class: "edit", title: seen ? "Select it in the tree" : "It was removed; release it to see it again" }, ...label);
  show.type = "button";
  if (!seen) show.setAttribute("aria-disabled", "true");
  show.addEventListener("click", () => { if (seen) pick(store, edit.limb); });
  const release = button({
    label: `${words.release}: ${words.where}`, icon: edit.what === "cleared" ? "undo" : "unlock", iconOnly: true, look: "quiet", hint: words.release,
    testId: `release-${edit.limb}`,
    onPress: () => store.send({ type: "lock", limb: edit.limb, on: false }),
  });
  return element("li", { data: { limb: edit.limb } }, show, release);
}

function pick(store: Store, limb: string): void {
  store.set("tool", "select");
  store.set("selected", limb);
}
