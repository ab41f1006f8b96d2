// How do leaves stand about their twig? As the species has them, or otherwise.

import { element, freshId } from "../../parts/element";
import type { Options } from "../../messages";
import type { Store } from "../../store";

type Arrangement = Options["leaf_arrangement"];
const OWN = "the species'";
const WORDS: Record<NonNullable<Arrangement>, string> = { alternate: "alternate", opposite: "opposite", decussate: "opposite, crosswise", whorled: "in whorls", spiral: "in a spiral" };

export function arrangement(store: Store): HTMLElement {
  const id = freshId("arrangement");
  const field = element("select", { class: "field", id, testId: "leaf-arrangement" }, new Option(OWN, ""), ...Object.entries(WORDS).map(([name, words]) => new Option(words, name)));
  const label = element("label", { class: "row-label" }, "Leaves stand");
  label.htmlFor = id;
  field.addEventListener("change", () => store.send({ type: "choose", options: { leaf_arrangement: field.value || null } }));
  field.addEventListener("keydown", (event) => event.stopPropagation()); // elsewhere letters choose tools
  store.on("options", () => { field.value = store.known.options?.leaf_arrangement ?? ""; });
  return element("div", { class: "row" }, label, field);
}
