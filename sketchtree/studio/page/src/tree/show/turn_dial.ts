// How far is the page turned? A dial seen from above: the knob is where the page is looked at from, the wedge is where the eye is now.

import { button } from "../../parts/button";
import { element } from "../../parts/element";
import type { Store } from "../../store";
import { shortest, snapped } from "../eye/eye";
import type { View } from "../view";

const CATCH = 3; // degrees: so close to a multiple of 45 it is one

export function turnDial(view: View, store: Store): void {
  const hand = element("span", { class: "tree-dial-hand" });
  const dial = element("div", { class: "tree-dial", role: "slider", tabindex: 0, "aria-label": "Turn of the page, degrees", "aria-valuemin": -180, "aria-valuemax": 180, "data-testid": "turn", title: "Turn the page: drag round, Shift for 45° steps, double click for the front" }, hand);
  const value = element("span", { class: "tree-dial-value" });
  const here = button({ label: "Page here", look: "quiet", testId: "page-here", hint: "Turn the page to where you look from, and draw there", onPress: () => turn(view.eye.azimuth) });
  view.root.append(element("div", { class: "tree-turn" }, dial, element("div", { class: "tree-turn-words" }, value, here)));

  const turn = (degrees: number): void => store.set("turn", Math.round(shortest(degrees)));
  const pointed = (event: PointerEvent): void => {
    const box = dial.getBoundingClientRect();
    const degrees = (Math.atan2(event.clientX - box.left - box.width / 2, event.clientY - box.top - box.height / 2) * 180) / Math.PI;
    const even = snapped(degrees, 45);
    turn(event.shiftKey || Math.abs(degrees - even) < CATCH ? even : degrees);
  };
  dial.addEventListener("pointerdown", (event) => { dial.setPointerCapture(event.pointerId); pointed(event); });
  dial.addEventListener("pointermove", (event) => { if (dial.hasPointerCapture(event.pointerId)) pointed(event); });
  dial.addEventListener("dblclick", () => turn(0));
  dial.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: -15, ArrowDown: -15, ArrowRight: 15, ArrowUp: 15 }[event.key];
    if (step === undefined && event.key !== "Home") return;
    event.preventDefault();
    event.stopPropagation();
    turn(step === undefined ? 0 : store.ui.turn + step);
  });
  const follow = (): void => {
    const now = Math.round(shortest(store.ui.turn));
    hand.style.transform = `rotate(${-now}deg)`;
    dial.setAttribute("aria-valuenow", String(now));
    value.textContent = now === 0 ? "Page: front" : `Page: ${Math.abs(now)}° ${now === 180 ? "" : now > 0 ? "right" : "left"}`;
  };
  store.on("turn", follow);
  follow();
  view.stage.afterDraw.push(() => {
    here.hidden = Math.abs(shortest(view.eye.azimuth - store.ui.turn)) < 2;
    dial.style.setProperty("--eye", `${-shortest(view.eye.azimuth)}deg`);
  });
}
