// How does one walk through many buttons with the keyboard? One of them is in the tab order; arrows, Home and End go from there.

export interface Roving {
  keep: () => void; // the buttons are others now: exactly one stays in the tab order
}

const STEPS: Record<string, number> = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 };

/** `buttons` gives those that are there now, in their order. */
export function roving(root: HTMLElement, buttons: () => HTMLElement[]): Roving {
  const enter = (one: HTMLElement): void => buttons().forEach((other) => { other.tabIndex = other === one ? 0 : -1; });
  root.addEventListener("keydown", (event) => {
    const all = buttons();
    const next = goal(event.key, all.indexOf(document.activeElement as HTMLElement), all.length);
    if (next === null || all.length === 0) return;
    event.preventDefault();
    event.stopPropagation(); // elsewhere arrows turn the page
    all[next]!.focus();
  });
  root.addEventListener("focusin", (event) => {
    const one = buttons().find((button) => button === event.target);
    if (one) enter(one);
  });
  return {
    keep() {
      const all = buttons();
      const inside = all.find((button) => button === document.activeElement);
      const chosen = all.find((button) => button.getAttribute("aria-pressed") === "true" || button.getAttribute("aria-checked") === "true");
      const one = inside ?? chosen ?? all[0];
      if (one) enter(one);
    },
  };
}

function goal(key: string, at: number, count: number): number | null {
  if (key === "Home") return 0;
  if (key === "End") return count - 1;
  const step = STEPS[key];
  return step === undefined || at < 0 ? null : Math.min(count - 1, Math.max(0, at + step));
}
