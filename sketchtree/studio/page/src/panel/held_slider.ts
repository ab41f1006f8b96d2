// A slider of something that the program keeps. It speaks while it is dragged, a few times a second; what the program answers meanwhile does not move it.

import { slider } from "../parts/slider";
import type { Store, Topic } from "../store";
import { pace } from "./pace";

export interface HeldLook<V> {
  label: string;
  hint: string;
  min: number;
  max: number;
  step: number;
  testId: string;
  usual: V; // what a double click goes back to
  back: string; // the same in words
  knob: (value: V) => number; // where the knob stands for a value
  value: (knob: number) => V;
  show: (value: V) => string;
  now: () => V | undefined; // as the program has it; undefined: nothing yet
  say: (value: V) => void;
}

const PAUSE = 120; // milliseconds between two words
const CALM = 600; // after the last move the program's answer counts again

export function heldSlider<V>(store: Store, topics: Topic[], look: HeldLook<V>): HTMLElement {
  let held: ReturnType<typeof setTimeout> | null = null;
  const say = pace<V>(PAUSE, look.say);
  const shown = (value: V): void => made.set(look.knob(value), look.show(value));
  const follow = (): void => {
    const now = look.now();
    if (held === null && now !== undefined) shown(now);
  };
  const moved = (value: V): void => {
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
  const made = slider({
    label: look.label, min: look.min, max: look.max, step: look.step, value: look.knob(look.usual), testId: look.testId, show: (knob) => look.show(look.value(knob)),
    hint: `${look.hint} Arrow keys move it, a double click takes it back.`, onInput: (knob) => moved(look.value(knob)), reset: { label: look.back, onReset: back },
  });
  made.input.addEventListener("change", () => say.flush());
  made.input.addEventListener("dblclick", back);
  made.input.addEventListener("keydown", (event) => { if (event.key.startsWith("Arrow")) event.stopPropagation(); }); // elsewhere arrows turn the page
  store.on(topics, follow);
  shown(look.usual);
  follow();
  return made.root;
}
