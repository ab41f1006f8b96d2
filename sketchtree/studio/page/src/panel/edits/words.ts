// How is something that was done by hand told in the list? By what it is and where.

import type { Edit, Limb } from "../../messages";

export interface EditWords {
  what: string;
  where: string;
  release: string; // what its button does
}

export function editWords(edit: Edit, limbs: readonly Limb[], order: readonly string[]): EditWords {
  const limb = limbs.find((one) => one.id === edit.limb);
  switch (edit.what) {
    case "held":
      return {
        what: limb?.locked ? "Locked" : edit.share.length > 1 ? `Depth held at ${edit.share.length} places` : "Depth held",
        where: name(limb, order), release: "Let it find its own depth again",
      };
    case "cleared":
      return { what: "Removed", where: "a grown branch", release: "Let it grow again" };
    case "adopted":
      return { what: "Kept", where: name(limb, order), release: "Let it grow as it would" };
  }
}

/** "trunk", "branch 4", "grown branch": the number is that of its first stroke in drawing order. */
function name(limb: Limb | undefined, order: readonly string[]): string {
  if (limb?.order === 0) return "trunk";
  const stroke = limb?.strokes[0];
  const number = stroke === undefined ? -1 : order.indexOf(stroke);
  if (number >= 0) return `branch ${number + 1}`;
  return "a grown branch";
}
