// What is the program at? Its stage and how far it is, with a button that stops it. Short work is not worth a flicker.

import { button } from "../../parts/button";
import { element } from "../../parts/element";
import type { Store } from "../../store";
import { doing } from "./words";

const SHORT = 250; // milliseconds
const SETTLED = 1200; // likewise, of what nobody waits for

export function work(store: Store): HTMLElement {
  const words = element("span", { class: "work-words" });
  const bar = element("progress", { aria: { label: "How far it is" } });
  bar.max = 1;
  const stop = button({
    label: "Stop", icon: "stop", look: "quiet", hint: "Stop this work. The drawing stays.", testId: "cancel", onPress: () => store.send({ type: "cancel" }),
  });
  stop.classList.add("in-line");
  const root = element("span", { class: "work", testId: "work" }, words, bar, stop);
  root.hidden = true;
  let soon: ReturnType<typeof setTimeout> | null = null;
  const show = (): void => {
    const { working, warming, connected } = store.known;
    const said = connected ? doing(working, warming) : "";
    const works = working?.state === "working";
    stop.hidden = !works;
    if (said) {
      words.textContent = said;
      if (works) bar.value = working.done;
      else bar.removeAttribute("value");
      soon ??= setTimeout(() => { root.hidden = false; }, works ? SHORT : SETTLED);
      return;
    }
    if (soon !== null) clearTimeout(soon);
    soon = null;
    root.hidden = true;
  };
  store.on(["working", "warming", "connected"], show);
  return root;
}
