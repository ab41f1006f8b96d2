// Several trees stand in a point cloud: which one is meant?

import { button } from "../../parts/button";
import { dialog } from "../../parts/dialog";
import { element } from "../../parts/element";

/** 1 the largest; `null`: none. */
export function treeDialog(name: string, trees: readonly string[]): Promise<number | null> {
  return new Promise((resolve) => {
    let answer: number | null = null;
    const box = dialog({ title: `${trees.length} trees stand in ${name}. Which one?`, testId: "trees-dialog", onClose: () => { box.root.remove(); resolve(answer); } });
    const one = (text: string, k: number): HTMLElement => {
      const made = element("button", { class: "way", testId: `tree-${k + 1}` }, element("strong", {}, `Tree ${k + 1}`), element("span", {}, text));
      made.type = "button";
      made.addEventListener("click", () => { answer = k + 1; box.close(); });
      return made;
    };
    box.body.append(element("div", { class: "ways" }, ...trees.map(one)));
    box.foot.append(button({ label: "Cancel", look: "quiet", onPress: box.close }));
    box.open();
    box.body.querySelector("button")?.focus();
  });
}
