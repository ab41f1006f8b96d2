// What does one template look like in the strip? Its picture, its name, how like it the drawing is, and whether it is chosen or used.

import { element } from "../../parts/element";
import { thumbnail } from "../../parts/thumbnail";

export interface CardLook {
  name: string;
  title: string;
  picture: string | null;
  hint: string;
}

export interface CardState {
  chosen: boolean; // the user's choice, "auto" too
  used: boolean; // the tree wears it
  bar: number | null; // 0-1
  title: string; // of "auto" also what it chose
}

export interface TemplateCard {
  root: HTMLButtonElement;
  show: (state: CardState) => void;
}

export function card(look: CardLook): TemplateCard {
  const root = element("button", { class: "template", title: look.hint, testId: `template-${look.name}`, data: { value: look.name } });
  root.type = "button";
  root.tabIndex = -1;
  const bar = element("span", { class: "template-bar", aria: { hidden: "true" } }, element("i"));
  const used = element("span", { class: "template-used" }, "in use");
  const title = element("span", { class: "template-title" }, look.title);
  root.append(picture(look), title, bar, used);
  const show = (state: CardState): void => {
    root.setAttribute("aria-pressed", String(state.chosen));
    root.classList.toggle("used", state.used);
    used.hidden = !state.used;
    title.textContent = state.title;
    bar.hidden = state.bar === null;
    bar.style.setProperty("--share", `${Math.round(100 * (state.bar ?? 0))}%`);
  };
  return { root, show };
}

function picture(look: CardLook): HTMLElement {
  if (look.picture === null) return element("span", { class: `template-picture plain ${look.name}`, aria: { hidden: "true" } });
  return thumbnail(look.picture, "template-picture");
}
