// The bar above: files to the left, steps back and on, the drawing's name; to the right how the page is laid out, and what leaves it.

import { openDialog } from "../panel/mount";
import { block, button, press, swapIcon } from "../parts/button";
import { element } from "../parts/element";
import type { Store } from "../store";
import { icon } from "../style/icons";
import { switchTheme } from "../style/theme";
import { isForOther, pressed } from "./keys";
import { newPage } from "./new_page";
import { makeSheet } from "./sheet";

export function mountBar(root: HTMLElement, store: Store): void {
  const sheet = makeSheet();
  const quiet = (label: string, name: Parameters<typeof icon>[0], key: string | undefined, testId: string, onPress: () => void): HTMLButtonElement =>
    button({ label, icon: name, iconOnly: true, look: "quiet", key, testId, onPress });
  const undo = quiet("Undo", "undo", "Ctrl+Z", "undo", () => store.send({ type: "undo" }));
  const redo = quiet("Redo", "redo", "Ctrl+Y", "redo", () => store.send({ type: "redo" }));
  const gallery = button({ label: "Examples", icon: "gallery", look: "quiet", testId: "gallery", onPress: () => openDialog("gallery") });
  const out = button({ label: "Export", icon: "export", look: "primary", key: "Ctrl+E", testId: "export", onPress: () => openDialog("export") });
  for (const one of [gallery, out]) one.classList.add("bar-word");
  root.append(
    element("span", { class: "mark", aria: { hidden: "true" } }, icon("branch")),
    quiet("New page", "new", "Ctrl+Alt+N", "new", () => newPage(store)),
    quiet("Open", "open", "Ctrl+O", "open", () => openDialog("open")),
    quiet("Save", "save", "Ctrl+S", "save", () => openDialog("save")),
    element("span", { class: "bar-gap", role: "separator" }), undo, redo, title(store), element("span", { class: "bar-space" }),
    gallery, layoutButton(store), themeButton(store), quiet("Keys and gestures", "help", "?", "help", () => sheet.open()), drawerButton(), out,
  );
  const show = (): void => {
    const { undo: back, redo: on } = store.known;
    block(undo, back === null ? "nothing to take back" : null);
    block(redo, on === null ? "nothing to do again" : null);
    undo.setAttribute("aria-label", back === null ? "Undo" : `Undo: ${back}`);
    redo.setAttribute("aria-label", on === null ? "Redo" : `Redo: ${on}`);
  };
  store.on(["undo", "redo"], show);
  show();
  listenFileKeys({ s: () => openDialog("save"), o: () => openDialog("open"), e: () => openDialog("export"), n: () => newPage(store), "?": () => sheet.open() });
}

/** The drawing's name, and a dot while its file is behind. */
function title(store: Store): HTMLElement {
  const name = element("span", { class: "name" });
  const unsaved = element("span", { class: "unsaved", title: "Not saved to a file yet. It is kept safe all the same.", role: "img", aria: { label: "not saved" } });
  const root = element("span", { class: "title" }, name, unsaved);
  const show = (): void => {
    name.textContent = (store.known.name ?? "Untitled").replace(/\.sketchtree$/, "");
    root.title = `${name.textContent}: the project's name`;
    root.classList.toggle("saved", store.known.saved);
    document.title = `${name.textContent} – SketchTree`;
  };
  store.on(["name", "saved"], show);
  show();
  return root;
}

function layoutButton(store: Store): HTMLButtonElement {
  const other = (): void => store.set("layout", store.ui.layout === "over" ? "beside" : "over");
  const made = button({ label: "The page over the tree", icon: "over", iconOnly: true, look: "quiet", testId: "layout", onPress: other });
  const show = (): void => {
    document.body.dataset.layout = store.ui.layout;
    press(made, store.ui.layout === "over");
    swapIcon(made, store.ui.layout === "over" ? "beside" : "over");
    made.title = store.ui.layout === "over" ? "Page and tree side by side" : "The page over the tree";
  };
  store.on("layout", show);
  show();
  return made;
}

function themeButton(store: Store): HTMLButtonElement {
  const made = button({ label: "Dark or light", icon: "moon", iconOnly: true, look: "quiet", testId: "theme", onPress: () => switchTheme(store) });
  const show = (): void => swapIcon(made, store.ui.theme === "dark" ? "sun" : "moon");
  store.on("theme", show);
  show();
  return made;
}

/** On a narrow screen the settings are a drawer. */
function drawerButton(): HTMLButtonElement {
  const other = (): void => set(document.body.dataset.side !== "open");
  const made = button({ label: "Settings", icon: "settings", iconOnly: true, look: "quiet", testId: "drawer", onPress: other });
  made.classList.add("bar-drawer");
  const set = (open: boolean): void => {
    document.body.dataset.side = open ? "open" : "shut";
    made.setAttribute("aria-expanded", String(open));
    press(made, open);
  };
  document.addEventListener("keydown", (event) => {
    if (event.key !== "Escape" || document.body.dataset.side !== "open") return;
    set(false);
    made.focus();
  });
  document.getElementById("stage")?.addEventListener("pointerdown", () => set(false));
  set(false);
  return made;
}

/** With Ctrl (Ctrl N is the browser's own where it does not give it away: Ctrl Alt N works everywhere), and `?` alone. */
function listenFileKeys(acts: Record<string, () => void>): void {
  document.addEventListener("keydown", (event) => {
    if (event.defaultPrevented || isForOther(event)) return;
    const key = pressed(event).replace("Alt+", "");
    const act = key === "?" ? acts["?"] : key.startsWith("Mod+") ? acts[key.slice(4)] : undefined;
    if (!act) return;
    event.preventDefault();
    act();
  });
}
