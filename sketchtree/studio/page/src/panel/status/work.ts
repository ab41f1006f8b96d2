// What is the program at? Its stage and how far it is, with a button that stops it. Short work is not worth a flicker.

import { button } from "../../parts/button";
import { element } from "../../parts/element";
import type { Store } from "../../store";
import { stage } from "./words";

const SHORT = 250; // milliseconds

export function work(store: Store): HTMLElement {
  const words = element("span", { class: "work-words" });
  const bar = element("progress", { aria: { label: "How far it is" } });
  bar.max = 1;
  const stop = button({
    label: "Stop", icon: "stop", look: "quiet", hint: "Stop this work. The drawing stays.", testId: "cancel", onPress: () => store.send({ type: "cancel" }),
  });
  stop.classList.add("in-line");
  const root = element("span", { class: "work" }, words, bar, stop);
  root.hidden = true;
  let soon: ReturnType<typeof setTimeout> | null = null;
  store.on(["working", "connected"], () => {
    const { working, connected } = store.known;
    if (working?.state === "working" && connected) {
      words.textContent = stage(working);
      bar.value = working.done;
      soon ??= setTimeout(() => { root.hidden = false; }, SHORT);
      return;
    }
    if (soon !== null) clearTimeout(soon);
    soon = null;
    root.hidden = true;
  });
  return root;
}
