// Which bark does the wood wear? The template's own, or any other.

import type { Store } from "../../store";
import { onList } from "../catalogue";
import { picturePicker } from "./picture_picker";

const OWN = "auto"; // on the wire: null

export function barkPicker(store: Store): HTMLElement {
  const made = picturePicker({
    label: "Bark", testId: "bark-picker", child: "bark",
    onPick: (value) => store.send({ type: "choose", options: { bark: value === OWN ? null : value } }),
  });
  onList(store, (welcome) => welcome.barks, (barks) => made.fill([
    { value: OWN, title: "Auto", picture: null },
    ...barks.map((one) => ({ value: one.name, title: one.title, picture: one.picture && store.address(one.picture) })),
  ]));
  store.on(["options", "tree", "welcome"], () => {
    const { options, tree, welcome } = store.known;
    const worn = welcome?.barks.find((one) => one.name === tree?.bark)?.title;
    made.set(options?.bark ?? OWN, (options?.bark ?? null) === null && worn ? `${worn} (template's)` : undefined);
  });
  return made.root;
}
