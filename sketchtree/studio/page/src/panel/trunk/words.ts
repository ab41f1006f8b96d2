// What is said while a tree is taken from scribbles? Words alone: no element is touched.

import type { Growing, Matte, Trunks } from "../../messages";

export const BEGIN = "Scribble on the tree, then on what is not tree.";
export const BEGIN_MOUSE = "Left button: on the tree. Right button: on what is not tree.";
const NOW_BESIDE = "Now on what is not tree: sky, ground, what stands behind.";
const NOW_TREE = "Now on the tree: along the trunk and a few limbs.";
const SOON = "It begins in a moment.";
const MATTE = "Finding the tree …";
const TRUNK = "Finding the trunk …";
const GROWS = "Growing the tree …";
const READY = "Grown from the scribbles.";
const STOPPED = "Stopped.";

export interface Known {
  trunks: Trunks | null;
  growing: Growing | null;
  matte: Matte | null;
}

/** One sentence; `how`: the first of them. */
export function said({ tree, beside }: { tree: boolean; beside: boolean }, { trunks, growing, matte }: Known, how: string = BEGIN): string {
  if (!tree && !beside) return how;
  if (!beside) return NOW_BESIDE;
  if (!tree) return NOW_TREE;
  switch (growing?.state) {
    case "waits": return SOON;
    case "grows": return trunks?.state === "ready" ? GROWS : trunks?.state === "works" && (matte?.revision ?? -1) >= trunks.revision ? TRUNK : MATTE;
    case "ready": return READY;
    case "stopped": return STOPPED;
    case "failed": return growing.remark;
    default: return SOON;
  }
}

const PASSED = "It was passed over."; // as the program says of each

/** Which edits of the contour find nothing on it any more? Empty: all are done. */
export function passedOver({ trunks }: Pick<Known, "trunks">): string {
  const count = trunks?.state === "ready" ? trunks.remark.split(PASSED).length - 1 : 0;
  return count === 0 ? "" : count === 1 ? "One of them finds nothing on this contour." : `${count} of them find nothing on this contour.`;
}
