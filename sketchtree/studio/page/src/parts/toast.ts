// A short word at the foot of the screen: what happened, what to do about it, one button at most.

import { icon } from "../style/icons";
import { button } from "./button";
import { element } from "./element";

export interface ToastLook {
  remedy?: string;
  kind?: "plain" | "wrong";
  action?: { label: string; onPress: () => void };
  seconds?: number; // how long it stays; errors stay until closed
}

const MOST = 3;
let shelf: HTMLElement | null = null;

/** Show it; returns what takes it away. */
export function toast(message: string, look: ToastLook = {}): () => void {
  shelf ??= element("div", { class: "toasts", role: "status", aria: { live: "polite" } });
  if (!shelf.isConnected) document.body.append(shelf);
  const wrong = look.kind === "wrong";
  const words = element("div", { class: "toast-words" }, element("strong", {}, message), look.remedy ? element("span", {}, look.remedy) : null);
  const made = element("div", { class: `toast${wrong ? " wrong" : ""}` }, icon(wrong ? "warn" : "check"), words);
  const away = (): void => made.remove();
  if (look.action) {
    const { label, onPress } = look.action;
    made.append(button({ label, look: "quiet", onPress: () => { away(); onPress(); } }));
  }
  made.append(button({ label: "Close", icon: "close", iconOnly: true, look: "quiet", onPress: away }));
  shelf.append(made);
  while (shelf.childElementCount > MOST) shelf.firstElementChild!.remove();
  if (!wrong) setTimeout(away, 1000 * (look.seconds ?? 5));
  return away;
}
