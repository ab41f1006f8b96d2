// Controls at the side, the strip of templates, the status line, the dialogs (stub).

import type { Store } from "../store";

export type Dialog = "open" | "save" | "gallery" | "export";

export interface PanelRoots {
  side: HTMLElement;
  strip: HTMLElement;
  status: HTMLElement;
}

export function mountPanels(roots: PanelRoots, store: Store): void {
  void roots;
  void store;
}

/** Show one of the dialogs. */
export function openDialog(which: Dialog): void {
  void which;
}
