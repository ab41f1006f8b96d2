// A dialog over everything: the focus stays inside, Escape or a press outside closes it, and then the focus is where it was.

import { button } from "./button";
import { element, freshId } from "./element";

export interface DialogLook {
  title: string;
  testId?: string;
  wide?: boolean;
  onClose?: () => void;
}

export interface Dialog {
  root: HTMLDialogElement;
  body: HTMLElement;
  foot: HTMLElement; // buttons, to the right
  open: () => void;
  close: () => void;
}

export function dialog(look: DialogLook): Dialog {
  const id = freshId("dialog");
  const root = element("dialog", { class: `dialog${look.wide ? " wide" : ""}`, testId: look.testId, aria: { labelledby: id } });
  const close = (): void => root.close();
  const shut = button({ label: "Close", icon: "close", iconOnly: true, look: "quiet", onPress: close });
  const head = element("header", { class: "dialog-head" }, element("h2", { id }, look.title), shut);
  const body = element("div", { class: "dialog-body" });
  const foot = element("footer", { class: "dialog-foot" });
  root.append(head, body, foot);
  let before: Element | null = null;
  root.addEventListener("pointerdown", (event) => {
    if (event.target === root && outside(root, event)) close();
  });
  root.addEventListener("keydown", (event) => event.stopPropagation()); // shortcuts of the page behind do not hear it
  root.addEventListener("close", () => {
    look.onClose?.();
    if (before instanceof HTMLElement || before instanceof SVGElement) before.focus();
  });
  const open = (): void => {
    if (!root.isConnected) document.body.append(root);
    if (root.open) return;
    before = document.activeElement;
    root.showModal();
  };
  return { root, body, foot, open, close };
}

function outside(root: HTMLElement, event: PointerEvent): boolean {
  const box = root.getBoundingClientRect();
  return event.clientX < box.left || event.clientX > box.right || event.clientY < box.top || event.clientY > box.bottom;
}
