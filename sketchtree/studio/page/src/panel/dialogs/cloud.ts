// A point cloud: does it lie behind the drawing that is there, or on a page of its own? And which of several trees in it?

import { button } from "../../parts/button";
import { dialog } from "../../parts/dialog";
import { element } from "../../parts/element";

const UNDER = "Its foot at the foot of your drawing, and as high as it. The limbs you drew take their depth from the points.";
const ALONE = "An empty page with the points behind it, to draw over or to trace.";

export type CloudUse = "cloud" | "drawing"; // behind the drawing, or in its place

/** Ask; `null`: neither. */
export function cloudDialog(): Promise<CloudUse | null> {
  return asked<CloudUse>("Where shall the points lie?", "cloud-dialog", [
    { answer: "cloud", title: "Behind my drawing", text: UNDER, testId: "cloud-under" },
    { answer: "drawing", title: "On a new page", text: ALONE, testId: "cloud-alone" },
  ]);
}

/** Which of several trees? 1 the largest; `null`: none. */
export function treeDialog(name: string, trees: readonly string[]): Promise<number | null> {
  return asked<number>(`${trees.length} trees stand in ${name}. Which one?`, "trees-dialog",
    trees.map((text, k) => ({ answer: k + 1, title: `Tree ${k + 1}`, text, testId: `tree-${k + 1}` })));
}

interface Way<A> {
  answer: A;
  title: string;
  text: string;
  testId: string;
}

function asked<A>(title: string, testId: string, ways: readonly Way<A>[]): Promise<A | null> {
  return new Promise((resolve) => {
    let answer: A | null = null;
    const box = dialog({ title, testId, onClose: () => { box.root.remove(); resolve(answer); } });
    const one = (way: Way<A>): HTMLElement => {
      const made = element("button", { class: "way", testId: way.testId }, element("strong", {}, way.title), element("span", {}, way.text));
      made.type = "button";
      made.addEventListener("click", () => { answer = way.answer; box.close(); });
      return made;
    };
    box.body.append(element("div", { class: "ways" }, ...ways.map(one)));
    box.foot.append(button({ label: "Cancel", look: "quiet", onPress: box.close }));
    box.open();
    box.body.querySelector("button")?.focus();
  });
}
