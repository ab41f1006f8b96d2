// A slider that says how the trunk is taken from its matte. It speaks while it is dragged, a few times a second; what the program answers meanwhile does not move it.

import type { Trunk } from "../../messages";
import { slider } from "../../parts/slider";
import type { Store } from "../../store";
import { pace } from "../pace";

export interface TrunkLook {
  of: "vertices" | "gap" | "levels";
  label: string;
  hint: string;
  min: number;
  max: number;
  step: number;
  usual: number | null; // what a double click goes back to
  knob: (value: number | null) => number; // where the knob stands for a value
  value: (knob: number) => number;
  show: (value: number | null) => string;
}

const PAUSE = 150; // milliseconds between two words
const CALM = 600; // after the last move the program's answer counts again

export function trunkSlider(store: Store, look: TrunkLook): HTMLElement {
  let held: ReturnType<typeof setTimeout> | null = null;
  const say = pace<number | null>(PAUSE, (value) => store.chooseTrunk({ [look.of]: value } as Partial<Trunk>, look.label.toLowerCase()));
  const shown = (value: number | null): void => made.set(look.knob(value), look.show(value));
  const follow = (): void => {
    if (held === null && store.known.trunk) shown(store.known.trunk[look.of]);
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
  const made = slider({
    label: look.label, min: look.min, max: look.max, step: look.step, value: look.knob(look.usual), testId: `trunk-${look.of}`, show: (knob) => look.show(look.value(knob)),
    hint: `${look.hint} Arrow keys move it, a double click takes it back.`, onInput: (knob) => moved(look.value(knob)),
    reset: { label: `back to ${look.show(look.usual)}`, onReset: back },
  });
  made.input.addEventListener("change", () => say.flush());
  made.input.addEventListener("dblclick", back);
  made.input.addEventListener("keydown", (event) => { if (event.key.startsWith("Arrow")) event.stopPropagation(); }); // elsewhere arrows turn the page
  store.on(["trunk", "trunks"], follow);
  follow();
  return made.root;
}
