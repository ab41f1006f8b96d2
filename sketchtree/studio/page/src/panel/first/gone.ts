// The program does not answer: what becomes of the drawing, and what helps? Short breaks are not worth a word.

import { element } from "../../parts/element";
import { icon } from "../../style/icons";
import type { Store } from "../../store";

const SHORT = 1500; // milliseconds

export function goneBanner(store: Store): HTMLElement {
  const title = element("strong", {});
  const words = element("span", {});
  const root = element("div", { class: "gone", role: "alert", testId: "gone" }, icon("warn"), element("div", {}, title, words));
  let soon: ReturnType<typeof setTimeout> | null = null;
  const show = (): void => {
    const met = store.known.welcome !== null;
    title.textContent = met ? "The studio does not answer." : "The studio is not there yet.";
    words.textContent = met
      ? " You can go on drawing: your lines are kept here, and join the tree when it is back. " +
        "If it stays away, run “sketchtree studio” in the terminal again: it goes on where it was."
      : " If it stays so, run “sketchtree studio” in the terminal, and open the address it prints.";
    root.hidden = false;
  };
  const follow = (): void => {
    if (soon !== null) clearTimeout(soon);
    soon = null;
    if (store.known.connected) root.hidden = true;
    else soon = setTimeout(show, SHORT);
  };
  root.hidden = true;
  store.on("connected", follow);
  follow();
  return root;
}
