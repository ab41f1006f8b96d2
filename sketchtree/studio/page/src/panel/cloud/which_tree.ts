// A cloud of the folder was to be opened, and several trees stand in it: which one?

import type { Store } from "../../store";
import { treeDialog } from "../dialogs/cloud";

export function askWhichTree(store: Store): void {
  store.on("several", () => {
    const asked = store.known.several;
    if (!asked) return;
    void treeDialog(asked.name, asked.trees).then((tree) => { if (tree !== null) store.send({ type: "open", name: asked.name, tree }); });
  });
}
