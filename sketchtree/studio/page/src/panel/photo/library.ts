// Which subtrees grow in a photo (Tan et al. 2008, §3.1): those of the limbs that show, forks at a branch's end, twigs along a branch. One of them at least.

import { element } from "../../parts/element";
import { toggle } from "../../parts/toggle";
import type { Store } from "../../store";

const PARTS = [
  { name: "visible", label: "Like the visible limbs", hint: "Copies of the limbs that show in the photo" },
  { name: "I", label: "Forks", hint: "Predefined subtrees of type I: they fork at a branch's end" },
  { name: "II", label: "Side twigs", hint: "Predefined subtrees of type II: twigs along a branch" },
] as const;

export function library(store: Store): HTMLElement {
  const chosen = (): string[] => (store.known.options?.library ?? "visible,I,II").split(",");
  const rows = PARTS.map(({ name, label, hint }) => {
    const made = toggle({
      label, on: true, hint, testId: `library-${name}`,
      onSwitch: (on) => {
        const next = PARTS.map((one) => one.name).filter((one) => (one === name ? on : chosen().includes(one)));
        if (next.length) store.send({ type: "choose", options: { library: next.join(",") } });
        else made.set(true); // nothing could grow
      },
    });
    return { name, made };
  });
  store.on("options", () => rows.forEach(({ name, made }) => made.set(chosen().includes(name))));
  return element("div", { role: "group", aria: { label: "What grows" } }, element("p", { class: "hint" }, "What grows"), ...rows.map(({ made }) => made.root));
}
