// A switch: on or off, at once.

import { element } from "./element";

export interface ToggleLook {
  label: string;
  on: boolean;
  hint?: string;
  testId?: string; // on the switch itself
  onSwitch: (on: boolean) => void;
}

export interface Toggle {
  root: HTMLElement;
  set: (on: boolean) => void;
}

export function toggle(look: ToggleLook): Toggle {
  const attributes = { class: "switch", role: "switch", title: look.hint, aria: { label: look.label }, testId: look.testId };
  const knob = element("button", attributes, element("span", { class: "switch-knob" }));
  knob.type = "button";
  const set = (on: boolean): void => knob.setAttribute("aria-checked", String(on));
  const flip = (): void => {
    const on = knob.getAttribute("aria-checked") !== "true";
    set(on);
    look.onSwitch(on);
  };
  knob.addEventListener("click", flip);
  const label = element("span", { class: "row-label", aria: { hidden: "true" } }, look.label);
  label.addEventListener("click", flip);
  set(look.on);
  return { root: element("div", { class: "row" }, label, knob), set };
}
