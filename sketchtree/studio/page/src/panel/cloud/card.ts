// Points of a scan lie behind the page: what they are good for, and what can be made of them. A card at the top of the page, in the place of that of a photo.

import { way } from "../../draw/trunk/way";
import { button } from "../../parts/button";
import { element } from "../../parts/element";
import { toggle } from "../../parts/toggle";
import type { Store } from "../../store";
import { icon } from "../../style/icons";
import { said } from "./words";

export function cloudCard(store: Store): HTMLElement {
  const words = element("p", { testId: "cloud-words", role: "status", aria: { live: "polite" } });
  const bar = element("progress", { aria: { label: "How far the tree is" }, testId: "cloud-progress" });
  bar.max = 1;
  const shown = toggle({ label: "Points", on: true, hint: "The points, on the page and beside the tree", testId: "cloud-shown", onSwitch: (on) => store.choosePoints({ shown: on }, on ? "show points" : "hide points") });
  const trace = button({ label: "Trace it", icon: "play", testId: "cloud-trace", hint: "The tree that stands in the points, traced", onPress: () => (store.known.points?.traced ? store.send({ type: "grow", on: true }) : store.choosePoints({ traced: true }, "trace points")) });
  const stop = button({ label: "Stop", icon: "stop", testId: "cloud-stop", hint: "Stop; the drawing is as it was", onPress: () => store.choosePoints({ traced: false }, "strokes") });
  const use = button({ label: "Use its limbs", testId: "cloud-use", look: "primary", hint: "The stoutest limbs become strokes, to be edited one by one; their depths stay, the rest grows", onPress: () => store.send({ type: "usetraced" }) });
  const back = button({ label: "My strokes", testId: "cloud-back", hint: "Back to the tree of your strokes", onPress: () => store.choosePoints({ traced: false }, "strokes") });
  const away = button({ label: "Take the points away", icon: "close", iconOnly: true, look: "quiet", testId: "cloud-away", hint: "The drawing stays; undo brings them back", onPress: () => store.send({ type: "setcloud", cloud: null }) });
  const root = element("div", { class: "hint-card photo-card", role: "group", aria: { label: "Points behind the page" }, testId: "cloud-card" },
    icon("cloud"), element("div", { class: "photo-said" }, words, bar), shown.root, trace, stop, use, back, away);
  const show = (): void => {
    const { cloud, points, growing, strokes } = store.known;
    root.hidden = cloud === null || way(store) !== "drawing";
    const now = said(points, growing);
    if (words.textContent !== now) words.textContent = now; // said aloud once
    const traced = points?.traced ?? false;
    const works = traced && (growing?.state === "grows" || growing?.state === "waits");
    const ready = traced && growing?.state === "ready";
    bar.hidden = !works;
    bar.value = growing?.done ?? 0;
    shown.set(points?.shown ?? true);
    trace.hidden = traced && (works || ready);
    stop.hidden = !works;
    use.hidden = !ready;
    back.hidden = !traced || works || (ready && strokes.size === 0);
    root.dataset["traced"] = traced ? (growing?.state ?? "none") : "none";
  };
  store.on(["cloud", "points", "growing", "underlay", "trunk", "strokes"], show);
  show();
  return root;
}
