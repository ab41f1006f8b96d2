// What does a cell of a notebook show? Tools, page and tree of the studio, in a room of their own (a shadow root), so that neither the notebook's styles reach
// them nor theirs the notebook.

import { mountDraw } from "./draw/mount";
import { mountTools } from "./draw/tools";
import { mountComm, type Model } from "./link/comm";
import { element } from "./parts/element";
import { Store } from "./store";
import styles from "./style/widget.css?inline";
import { mountTree } from "./tree/mount";
import { mountWords } from "./widget/words";

interface Cell {
  model: Model;
  el: HTMLElement;
}

let close: (() => void) | null = null; // the one view there is: two would draw on the same page with one camera

function render({ model, el }: Cell): () => void {
  close?.();
  const store = new Store();
  const inside = room(el, Number(model.get("height")) || 480);
  store.set("theme", isDark() ? "dark" : "light");
  inside.dataset.theme = store.ui.theme;
  const part = (tag: "nav" | "section" | "footer", id: string, label: string): HTMLElement => element(tag, { id, aria: { label } });
  const tools = part("nav", "tools", "Tools");
  const page = part("section", "page", "Drawing");
  const tree = part("section", "tree", "Tree in 3D");
  const status = part("footer", "status", "State");
  inside.append(tools, element("main", { id: "stage" }, page, tree), status);
  mountTools(tools, store);
  mountDraw(page, store);
  mountTree(tree, store);
  mountWords(status, store);
  const end = mountComm(store, model);
  const mine = (): void => {
    end();
    if (close === mine) close = null;
    inside.replaceChildren(element("p", { class: "elsewhere" }, "This drawing is shown in another cell."));
  };
  close = mine;
  return mine;
}

/** The element that everything is in. Keys pressed in it are not the notebook's: JupyterLab leaves alone what is marked so, others hear nothing. */
function room(el: HTMLElement, height: number): HTMLElement {
  el.dataset.lmSuppressShortcuts = "true";
  el.addEventListener("keydown", (event) => event.stopPropagation());
  const shadow = el.shadowRoot ?? el.attachShadow({ mode: "open" });
  const sheet = new CSSStyleSheet();
  sheet.replaceSync(styles.replaceAll(":root", ":host"));
  shadow.adoptedStyleSheets = [sheet];
  const inside = element("div", { class: "cell", tabindex: -1 });
  inside.style.height = `${height}px`;
  shadow.replaceChildren(inside);
  return inside;
}

/** JupyterLab and VS Code say so on the body; else what the system prefers. */
function isDark(): boolean {
  const { jpThemeLight, vscodeThemeKind } = document.body.dataset;
  if (jpThemeLight) return jpThemeLight === "false";
  if (vscodeThemeKind) return vscodeThemeKind.includes("dark");
  return matchMedia("(prefers-color-scheme: dark)").matches;
}

export default { render };
