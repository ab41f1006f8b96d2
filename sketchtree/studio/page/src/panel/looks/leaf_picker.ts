// Which leaves does the tree wear? The template's own, any other, or none.

import type { Store } from "../../store";
import { onList } from "../catalogue";
import { picturePicker } from "./picture_picker";

const OWN = "auto"; // on the wire: null

export function leafPicker(store: Store): HTMLElement {
  const made = picturePicker({
    label: "Leaves", testId: "leaf-picker", child: "leaf",
    onPick: (value) => store.send({ type: "choose", options: { leaf: value === OWN ? null : value } }),
  });
  onList(store, (welcome) => welcome.leaves, (leaves) => made.fill([
    { value: OWN, title: "Auto", picture: null },
    { value: "none", title: "None", picture: null },
    ...leaves.filter((one) => one.name !== "none").map((one) => ({ value: one.name, title: one.title, picture: one.picture && store.address(one.picture) })),
  ]));
  store.on(["options", "tree", "welcome"], () => {
    const { options, tree, welcome } = store.known;
    const worn = welcome?.leaves.find((one) => one.name === tree?.leaf)?.title;
    made.set(options?.leaf ?? OWN, (options?.leaf ?? null) === null && worn ? `${worn} (template's)` : undefined);
  });
  return made.root;
}
