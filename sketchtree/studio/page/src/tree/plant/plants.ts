// Which plant is on the screen: the tree, the one that grew in a photo, or only a glance at how it would be with another template? Each is kept apart, so that
// the tree is whole when the next frame of it comes, or the photo's is gone.

import type { Tree } from "../../messages";
import type { Arrays } from "../../store";
import { grown, NO_PLANT, type Plant } from "./plant";

export class Plants {
  private tree: Plant = NO_PLANT;
  private photo: Plant | null = null;

  /** The plant to show after this frame; null: what is shown stays. */
  take(head: Tree, arrays: Arrays): Plant | null {
    if (head.phase === "photo") return (this.photo = grown(NO_PLANT, head, arrays));
    const plant = grown(this.tree, head, arrays);
    if (head.phase === "glance") return plant;
    this.tree = plant;
    return this.photo ? null : plant;
  }

  /** Away with the photo's: the tree to show. */
  leavePhoto(): Plant {
    this.photo = null;
    return this.tree;
  }
}
