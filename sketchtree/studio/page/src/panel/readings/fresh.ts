// Are the readings still of this drawing? Seed, season and the like change nothing about them; strokes, edits and what the depths hang on do.

import type { Edit, Options, Stroke } from "../../messages";
import type { Known } from "../../store";

const DEPTHS_HANG_ON = ["template", "theta", "height", "planar", "crown"] as const;

export class Fresh {
  private strokes: Stroke[] = [];
  private edits: Edit[] = [];
  private options = "";

  /** What is there now is what they are of. */
  keep(known: Known): void {
    this.strokes = [...known.strokes.values()];
    this.edits = known.edits;
    this.options = stamp(known.options);
  }

  holds(known: Known): boolean {
    if (known.strokes.size !== this.strokes.length || known.edits !== this.edits || stamp(known.options) !== this.options) return false;
    let place = 0;
    for (const stroke of known.strokes.values()) if (stroke !== this.strokes[place++]) return false;
    return true;
  }
}

function stamp(options: Options | null): string {
  return JSON.stringify(DEPTHS_HANG_ON.map((name) => options?.[name]));
}
