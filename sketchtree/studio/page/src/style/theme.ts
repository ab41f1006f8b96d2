// Dark or light? What the system prefers, until one is chosen; the choice stays in this browser.

import type { Store } from "../store";

const KEY = "sketchtree-theme";

export function mountTheme(store: Store): void {
  const system = matchMedia("(prefers-color-scheme: dark)");
  const chosen = (): "light" | "dark" | null => {
    const kept = localStorage.getItem(KEY);
    return kept === "light" || kept === "dark" ? kept : null;
  };
  const follow = (): void => store.set("theme", chosen() ?? (system.matches ? "dark" : "light"));
  const show = (): void => { document.documentElement.dataset.theme = store.ui.theme; };
  store.on("theme", show);
  system.addEventListener("change", follow);
  follow();
  show();
}

/** The other theme, from now on. */
export function switchTheme(store: Store): void {
  const next = store.ui.theme === "dark" ? "light" : "dark";
  localStorage.setItem(KEY, next);
  store.set("theme", next);
}
