// One of many by its picture: a grid of them under a head that names the chosen one. Arrows move the focus, Enter or Space picks.

import { element } from "../../parts/element";
import { thumbnail } from "../../parts/thumbnail";
import { roving } from "../roving";

export interface Pickable {
  value: string;
  title: string;
  picture: string | Element | null; // an address, or a drawing
}

export interface PickerLook {
  label: string;
  testId: string;
  child: string; // test ids of the choices: child-value
  onPick: (value: string) => void;
}

export interface Picker {
  root: HTMLElement;
  fill: (choices: Pickable[]) => void;
  set: (value: string, words?: string) => void; // words: shown in place of its title
}

export function picturePicker(look: PickerLook): Picker {
  const words = element("span", { class: "row-value" });
  const grid = element("div", { class: "pictures", role: "radiogroup", aria: { label: look.label }, testId: look.testId });
  const root = element("div", { class: "picker" }, element("div", { class: "row" }, element("span", { class: "row-label" }, look.label), words), grid);
  const buttons = (): HTMLElement[] => [...grid.querySelectorAll<HTMLElement>(".picture")];
  const walk = roving(grid, buttons);
  let titles = new Map<string, string>();
  let now: [string, string | undefined] = ["", undefined];
  const set = (value: string, said?: string): void => {
    now = [value, said];
    words.textContent = said ?? titles.get(value) ?? "";
    for (const one of buttons()) one.setAttribute("aria-checked", String(one.dataset["value"] === value));
    walk.keep();
  };
  const fill = (choices: Pickable[]): void => {
    titles = new Map(choices.map((one) => [one.value, one.title]));
    grid.replaceChildren(...choices.map((one) => picture(one, look)));
    set(...now);
  };
  grid.addEventListener("click", (event) => {
    const value = event.target instanceof Element ? event.target.closest<HTMLElement>(".picture")?.dataset["value"] : undefined;
    if (value === undefined) return;
    set(value);
    look.onPick(value);
  });
  return { root, fill, set };
}

function picture(one: Pickable, look: PickerLook): HTMLElement {
  const marks = { testId: `${look.child}-${one.value}`, data: { value: one.value } };
  const made = element("button", { class: "picture", role: "radio", title: one.title, aria: { label: one.title }, ...marks });
  made.type = "button";
  made.tabIndex = -1;
  if (typeof one.picture === "string") {
    made.append(thumbnail(one.picture, "picture-image"));
  } else made.append(one.picture ?? element("span", { class: "picture-word" }, one.title));
  return made;
}
