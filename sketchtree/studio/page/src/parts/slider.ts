// A number on a slider, with its name and its value in words; `reset` takes it back to what the template says.

import { icon } from "../style/icons";
import { element, freshId } from "./element";

export interface SliderLook {
  label: string;
  min: number;
  max: number;
  step: number;
  value: number;
  testId?: string; // on the input itself
  hint?: string;
  show?: (value: number) => string;
  onInput: (value: number) => void; // on each move
  reset?: { label: string; onReset: () => void }; // a small button beside the value
}

export interface Slider {
  root: HTMLElement;
  input: HTMLInputElement;
  set: (value: number, words?: string) => void; // words: shown in place of the number
}

export function slider(look: SliderLook): Slider {
  const id = freshId("slider");
  const input = element("input", { class: "slider", id, testId: look.testId, title: look.hint });
  input.type = "range";
  input.min = String(look.min);
  input.max = String(look.max);
  input.step = String(look.step);
  const label = element("label", { class: "row-label" }, look.label);
  label.htmlFor = id;
  const value = element("output", { class: "row-value" });
  value.htmlFor.add(id);
  const head = element("div", { class: "slider-head" }, label, value);
  if (look.reset) {
    const words = `${look.label}: ${look.reset.label}`;
    const back = element("button", { class: "button quiet only tiny", title: look.reset.label, aria: { label: words } }, icon("reset"));
    back.type = "button";
    back.addEventListener("click", look.reset.onReset);
    head.append(back);
  }
  const show = look.show ?? ((number: number) => String(Math.round(number * 100) / 100));
  const set = (number: number, words?: string): void => {
    input.value = String(number);
    const part = (Number(input.value) - look.min) / (look.max - look.min);
    input.style.setProperty("--part", `${(100 * part).toFixed(1)}%`);
    value.textContent = words ?? show(number);
    input.setAttribute("aria-valuetext", value.textContent);
  };
  input.addEventListener("input", () => {
    set(input.valueAsNumber);
    look.onInput(input.valueAsNumber);
  });
  set(look.value);
  return { root: element("div", { class: "row slider-row" }, head, input), input, set };
}
