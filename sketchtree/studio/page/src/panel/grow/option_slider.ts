// A slider that is one of the tree's options. It speaks while it is dragged, ten times a second at most; what the program answers meanwhile does not move it.

import type { Options } from "../../messages";
import { slider } from "../../parts/slider";
import type { Store } from "../../store";
import { pace } from "../pace";

export interface OptionLook {
  option: "generations" | "density" | "gravity" | "light" | "leaf_size" | "leaf_density";
  label: string;
  hint: string;
  min: number;
  max: number;
  step: number;
  usual: number | null; // what a double click goes back to; null: what the template says
  rest: number; // where the knob stands then
  show: (value: number) => string;
  auto?: string; // what is shown where the option is null
}

const PAUSE = 100; // milliseconds between two words
const CALM = 500; // after the last move the program's answer counts again

export function optionSlider(store: Store, look: OptionLook): HTMLElement {
  let held: ReturnType<typeof setTimeout> | null = null;
  const say = pace<number | null>(PAUSE, (value) => store.send({ type: "choose", options: { [look.option]: value } }));
  const shown = (value: Options[typeof look.option]): void => {
    if (value === null) made.set(look.rest, look.auto);
    else made.set(value, look.show(value));
  };
  const follow = (): void => {
    if (held === null && store.known.options) shown(store.known.options[look.option]);
  };
  const moved = (value: number | null): void => {
    if (held !== null) clearTimeout(held);
    held = setTimeout(() => {
      held = null;
      follow();
    }, CALM);
    say.say(value);
  };
  const back = (): void => {
    shown(look.usual);
    moved(look.usual);
    say.flush();
  };
  const reset = { label: look.usual === null ? "back to automatic" : `back to ${look.show(look.usual)}`, onReset: back };
  const made = slider({
    label: look.label, min: look.min, max: look.max, step: look.step, value: look.rest, testId: look.option, show: look.show, reset, onInput: moved,
    hint: `${look.hint} Arrow keys move it, a double click takes it back.`,
  });
  made.input.addEventListener("change", () => say.flush());
  made.input.addEventListener("dblclick", back);
  made.input.addEventListener("keydown", (event) => { if (event.key.startsWith("Arrow")) event.stopPropagation(); }); // elsewhere arrows turn the page
  shown(look.usual);
  store.on("options", follow);
  return made.root;
}
