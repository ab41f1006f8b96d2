// What few want of a trunk from scribbles: another way to find the matte or the depths, and where it stands.

import type { Trunk } from "../../messages";
import { button } from "../../parts/button";
import { choice } from "../../parts/choice";
import { element, freshId } from "../../parts/element";
import type { Store } from "../../store";

const MATTINGS: Record<Trunk["matting"], string> = { layered: "Layered", "closed-form": "Closed form", normalised: "Normalised" };

export function moreTrunk(store: Store): HTMLElement {
  const id = freshId("matting");
  const matting = element("select", { class: "field", id, testId: "trunk-matting", title: "Layered: ours. Closed form: Levin et al. Normalised: the paper's" },
    ...Object.entries(MATTINGS).map(([value, words]) => new Option(words, value)));
  matting.addEventListener("change", () => store.chooseTrunk({ matting: matting.value as Trunk["matting"] }, "matting"));
  matting.addEventListener("keydown", (event) => event.stopPropagation()); // elsewhere letters choose tools
  const label = element("label", { class: "row-label" }, "Matte by");
  label.htmlFor = id;
  const lift = choice<Trunk["lift"]>({
    label: "Depths by", showLabel: true, value: "siblings", testId: "trunk-lift",
    options: [
      { value: "siblings", label: "Siblings", title: "Branches of one parent stand round it, as the paper has it" },
      { value: "elevation", label: "Inference", title: "As those of a drawing, with a template's angles" },
    ],
    onPick: (value) => store.chooseTrunk({ lift: value }, "depths"),
  });
  const stands = element("span", { class: "row-value" });
  const back = button({ label: "Find it again", look: "quiet", testId: "trunk-foot-back", hint: "In the middle of the trunk's foot", onPress: () => store.chooseTrunk({ root: null }, "foot") });
  const point = button({ label: "Show where", testId: "trunk-foot", hint: "Click in the photo where the trunk stands", key: "R", onPress: () => store.set("tool", "foot") });
  const show = (): void => {
    const { trunk } = store.known;
    if (!trunk) return;
    matting.value = trunk.matting;
    lift.set(trunk.lift);
    stands.textContent = trunk.root ? trunk.root.map(Math.round).join(", ") : "found";
    back.hidden = trunk.root === null;
  };
  store.on("trunk", show);
  show();
  return element("details", { class: "more", testId: "trunk-more" }, element("summary", {}, "More"),
    element("div", { class: "row" }, label, matting), lift.root,
    element("div", { class: "row" }, element("span", { class: "row-label" }, "It stands at"), stands), element("div", { class: "buttons" }, point, back));
}
