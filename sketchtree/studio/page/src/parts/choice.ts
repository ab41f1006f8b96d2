// One of a few, as a row of buttons: a radio group in which the arrows move.

import { icon, type IconName } from "../style/icons";
import { element } from "./element";

export interface ChoiceOption<T extends string> {
  value: T;
  label: string;
  icon?: IconName;
  title?: string;
  testId?: string;
}

export interface ChoiceLook<T extends string> {
  label: string; // of the group
  options: ChoiceOption<T>[];
  value: T;
  testId?: string;
  showLabel?: boolean; // the group's label is shown, not only read aloud
  onPick: (value: T) => void;
}

export interface Choice<T extends string> {
  root: HTMLElement;
  set: (value: T) => void;
}

export function choice<T extends string>(look: ChoiceLook<T>): Choice<T> {
  const row = element("div", { class: "choice", role: "radiogroup", aria: { label: look.label }, testId: look.testId });
  const root = look.showLabel ? element("div", { class: "row" }, element("span", { class: "row-label" }, look.label), row) : row;
  const buttons = look.options.map((option) => {
    const made = element("button", { class: "choice-option", role: "radio", title: option.title, testId: option.testId, data: { value: option.value } });
    made.type = "button";
    if (option.icon) made.append(icon(option.icon));
    made.append(element("span", {}, option.label));
    made.addEventListener("click", () => pick(option.value));
    row.append(made);
    return made;
  });
  const set = (value: T): void => buttons.forEach((made) => {
    const on = made.dataset.value === value;
    made.setAttribute("aria-checked", String(on));
    made.tabIndex = on ? 0 : -1;
  });
  const pick = (value: T): void => {
    set(value);
    look.onPick(value);
  };
  row.addEventListener("keydown", (event) => {
    const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
    if (!step) return;
    event.preventDefault();
    event.stopPropagation();
    const at = buttons.findIndex((made) => made.matches(":focus"));
    const next = (at + step + buttons.length) % buttons.length;
    buttons[next]!.focus();
    pick(look.options[next]!.value);
  });
  set(look.value);
  return { root, set };
}
