// A part of the side panel that folds. Whether it is open stays in this browser.

import { element } from "../../parts/element";
import { icon } from "../../style/icons";

export interface Section {
  root: HTMLDetailsElement;
  body: HTMLElement;
  mark: (text: string) => void; // beside the title: how many there are
}

export function section(name: string, title: string, open: boolean, ...content: Node[]): Section {
  const key = `sketchtree-section-${name}`;
  const badge = element("span", { class: "section-mark" });
  const body = element("div", { class: "section-body" }, ...content);
  const root = element("details", { class: "section", testId: `section-${name}` }, element("summary", {}, icon("down"), element("h2", {}, title), badge), body);
  const kept = localStorage.getItem(key);
  root.open = kept === null ? open : kept === "open";
  root.addEventListener("toggle", () => localStorage.setItem(key, root.open ? "open" : "shut"));
  return { root, body, mark: (text) => { badge.textContent = text; } };
}
