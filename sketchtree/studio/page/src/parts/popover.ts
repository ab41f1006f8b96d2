// Something small beside what called it. A press elsewhere or Escape closes it (the browser's own popover does both).

import { element } from "./element";

export interface Popover {
  root: HTMLElement;
  open: () => void;
  close: () => void;
}

const APART = 6; // CSS pixels between it and its anchor

export function popover(anchor: HTMLElement, content: HTMLElement, testId?: string): Popover {
  const root = element("div", { class: "popover", testId }, content);
  root.popover = "auto";
  anchor.setAttribute("aria-haspopup", "dialog");
  root.addEventListener("toggle", (event) => anchor.setAttribute("aria-expanded", String((event as ToggleEvent).newState === "open")));
  const open = (): void => {
    if (!root.isConnected) (anchor.closest(".cell") ?? document.body).append(root); // in a notebook's cell it stays in there
    root.showPopover();
    place(root, anchor);
    root.querySelector<HTMLElement>("button, input, [tabindex]")?.focus();
  };
  return { root, open, close: () => root.hidePopover() };
}

/** Below its anchor, or above where there is no room; never over the edge. */
function place(root: HTMLElement, anchor: HTMLElement): void {
  const by = anchor.getBoundingClientRect();
  const own = root.getBoundingClientRect();
  const below = by.bottom + APART + own.height <= innerHeight;
  const top = below ? by.bottom + APART : Math.max(APART, by.top - APART - own.height);
  root.style.left = `${Math.max(APART, Math.min(by.left, innerWidth - own.width - APART))}px`;
  root.style.top = `${top}px`;
}
