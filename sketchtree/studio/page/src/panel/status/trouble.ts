// What could not be done, why, and what helps? A calm card over the page. It goes when it is closed, or when a tree was made after all.

import { camera } from "../../draw/camera";
import type { Stroke } from "../../messages";
import { button } from "../../parts/button";
import { element } from "../../parts/element";
import { icon } from "../../style/icons";
import type { Store } from "../../store";

const AROUND = 0.3; // of the page's view, on each side of the stroke that is shown

export function troubleCard(store: Store): HTMLElement {
  const cause = element("strong", {});
  const remedy = element("p", {});
  const show = button({ label: "Show the line", icon: "eye", look: "quiet", testId: "trouble-stroke", onPress: () => { point(store); } });
  const close = button({ label: "Close", icon: "close", iconOnly: true, look: "quiet", onPress: () => settle(store) });
  const words = element("div", { class: "trouble-words" }, cause, remedy, show);
  const root = element("div", { class: "trouble", role: "alert", testId: "trouble" }, icon("warn"), words, close);
  root.hidden = true;
  store.on("trouble", () => {
    const trouble = store.known.trouble;
    root.hidden = trouble === null;
    if (!trouble) return;
    cause.textContent = trouble.message;
    remedy.textContent = trouble.remedy;
    show.hidden = trouble.stroke === null || !store.known.strokes.has(trouble.stroke);
  });
  store.on("tree", () => {
    const { trouble, drawnTree } = store.known;
    if (trouble?.about === "drawing" && drawnTree?.phase === "full") settle(store);
  });
  return root;
}

function settle(store: Store): void {
  store.known.trouble = null;
  store.tell("trouble");
}

/** The stroke at fault is selected and comes into the middle of the page. */
function point(store: Store): void {
  const id = store.known.trouble?.stroke;
  const stroke = id ? store.known.strokes.get(id) : undefined;
  if (!stroke) return;
  store.set("tool", "select");
  store.set("turn", stroke.view_deg);
  store.set("selectedStrokes", [stroke.id]);
  camera.fit(box(stroke), AROUND);
}

function box(stroke: Stroke): { left: number; top: number; width: number; height: number } {
  const xs = stroke.xy.filter((_, index) => index % 2 === 0);
  const ys = stroke.xy.filter((_, index) => index % 2 === 1);
  const [left, top] = [xs.reduce((a, b) => Math.min(a, b)), ys.reduce((a, b) => Math.min(a, b))];
  return { left, top, width: xs.reduce((a, b) => Math.max(a, b)) - left, height: ys.reduce((a, b) => Math.max(a, b)) - top };
}
