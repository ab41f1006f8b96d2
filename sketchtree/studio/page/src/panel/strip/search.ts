// Which template is looked for? A small field at the strip's head; Escape empties it.

import { element, freshId } from "../../parts/element";

export function search(label: string, onType: (typed: string) => void): HTMLElement {
  const id = freshId("search");
  const field = element("input", { class: "field search", id, testId: "template-search", title: label });
  field.type = "search";
  field.placeholder = label;
  field.autocomplete = "off";
  field.spellcheck = false;
  field.setAttribute("aria-label", label);
  field.addEventListener("input", () => onType(field.value));
  field.addEventListener("keydown", (event) => {
    event.stopPropagation(); // letters are not shortcuts here
    if (event.key !== "Escape" || field.value === "") return;
    field.value = "";
    onType("");
  });
  return field;
}
