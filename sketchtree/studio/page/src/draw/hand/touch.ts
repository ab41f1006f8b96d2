// What does a tool hear of the pen? Where it is, how hard it presses, when, and which keys are held; never which kind of event told it.

import type { Sample } from "../line/samples";

export interface Touch extends Sample {
  px: number; // CSS pixels of the canvas
  py: number;
  pen: boolean; // a pen, whose pressure means something
  alt: boolean;
  shift: boolean;
}

export interface Tool {
  readonly cursor: string;
  readonly held?: string; // its cursor while it is pressed, where that is another
  down: (at: Touch) => void;
  move: (fresh: Touch[], predicted: Touch[]) => void; // all places since the last time
  up: (at: Touch) => void;
  cancel: () => void; // as if it had never been down
  hover: (at: Touch | null) => void; // not pressed; null: gone from the page
}
