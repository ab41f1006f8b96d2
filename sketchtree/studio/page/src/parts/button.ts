// A button, with a word, an icon, or both. One that cannot be pressed says why, so it stays reachable by keyboard.

import { icon, type IconName } from "../style/icons";
import { element } from "./element";

export interface ButtonLook {
  label: string; // its name: shown, or read aloud where there is only an icon
  icon?: IconName;
  iconOnly?: boolean;
  hint?: string; // what it does, for the tooltip; without: the label
  key?: string; // its shortcut, as people write it: "Ctrl+Z"
  testId?: string;
  look?: "plain" | "quiet" | "primary" | "danger";
  onPress: (event: MouseEvent) => void;
}

export function button(look: ButtonLook): HTMLButtonElement {
  const made = element("button", { class: `button ${look.look ?? "plain"}${look.iconOnly ? " only" : ""}`, testId: look.testId });
  made.type = "button";
  if (look.icon) made.append(icon(look.icon));
  if (look.iconOnly) made.setAttribute("aria-label", look.label);
  else made.append(element("span", {}, look.label));
  const hint = (look.hint ?? (look.iconOnly ? look.label : "")) + (look.key ? ` (${look.key})` : "");
  if (hint) made.title = hint.trim();
  if (look.key) made.setAttribute("aria-keyshortcuts", look.key.replaceAll("Ctrl", "Control"));
  made.dataset.hint = made.title;
  made.addEventListener("click", (event) => {
    if (made.getAttribute("aria-disabled") !== "true") look.onPress(event);
  });
  return made;
}

/** It cannot be pressed now, and why; `null`: it can. */
export function block(made: HTMLButtonElement, reason: string | null): void {
  if (reason === null) made.removeAttribute("aria-disabled");
  else made.setAttribute("aria-disabled", "true");
  made.title = reason === null ? (made.dataset.hint ?? "") : [made.dataset.hint, reason].filter(Boolean).join(": ");
}

/** It is pressed in, or not. */
export function press(made: HTMLButtonElement, is: boolean): void {
  made.setAttribute("aria-pressed", String(is));
}

/** Another icon in its place. */
export function swapIcon(made: HTMLButtonElement, name: IconName): void {
  made.querySelector("svg")?.replaceWith(icon(name));
}
