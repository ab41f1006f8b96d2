// Which plant is on the screen: the tree, or only a glance at how it would be with another template? A glance is kept apart, so that the tree is whole when the
// next frame of it comes.

import type { Tree } from "../../messages";
import type { Arrays } from "../../store";
import { grown, NO_PLANT, type Plant } from "./plant";

export class Plants {
  private tree: Plant = NO_PLANT;

  /** The plant to show after this frame. */
  take(head: Tree, arrays: Arrays): Plant {
    const plant = grown(this.tree, head, arrays);
    if (head.phase !== "glance") this.tree = plant;
    return plant;
  }
}
