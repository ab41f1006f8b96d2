// What does a hand on the view want? Left or one finger turns, right, middle, Shift or two fingers move, wheel or pinch come nearer; a flick goes on for a while.

export interface Wishes {
  turn: (right: number, down: number) => void; // CSS pixels
  move: (right: number, down: number) => void;
  near: (factor: number, x: number, y: number) => void; // about a point, CSS pixels from the middle
  flung: (right: number, down: number) => void; // pixels a second, when a turning hand lets go
  taken: () => void; // a hand is on it: what was moving stops
  clicked: (event: PointerEvent) => void; // pressed and let go on the spot
  hovered: (event: PointerEvent) => void;
}

const STILL = 5; // pixels a click may slip
const LATE = 60; // milliseconds without a move before letting go: no flick

interface Held {
  x: number;
  y: number;
}

export function listen(view: HTMLElement, wishes: Wishes): void {
  const held = new Map<number, Held>();
  let slipped = 0;
  let moving = false; // moves, not turns
  let pace = { right: 0, down: 0, at: 0 };

  view.addEventListener("pointerdown", (event) => {
    if (event.target !== view && !(event.target as HTMLElement).matches("canvas")) return;
    wishes.taken();
    view.setPointerCapture(event.pointerId);
    if (held.size === 0) [slipped, moving] = [0, event.button !== 0 || event.shiftKey];
    held.set(event.pointerId, { x: event.clientX, y: event.clientY });
    pace = { right: 0, down: 0, at: event.timeStamp };
  });

  view.addEventListener("pointermove", (event) => {
    const was = held.get(event.pointerId);
    if (!was) return held.size ? undefined : wishes.hovered(event);
    const [right, down] = [event.clientX - was.x, event.clientY - was.y];
    slipped += Math.hypot(right, down);
    if (held.size === 2) pinch(event, was);
    held.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (held.size !== 1 || slipped < STILL) return;
    if (moving) return wishes.move(right, down);
    wishes.turn(right, down);
    const since = Math.max(1, event.timeStamp - pace.at) / 1000;
    pace = { right: 0.6 * pace.right + (0.4 * right) / since, down: 0.6 * pace.down + (0.4 * down) / since, at: event.timeStamp };
  });

  function pinch(event: PointerEvent, was: Held): void {
    const other = [...held].find(([id]) => id !== event.pointerId)![1];
    const box = view.getBoundingClientRect();
    const factor = Math.hypot(event.clientX - other.x, event.clientY - other.y) / Math.max(8, Math.hypot(was.x - other.x, was.y - other.y));
    wishes.near(factor, (event.clientX + other.x) / 2 - box.left - box.width / 2, (event.clientY + other.y) / 2 - box.top - box.height / 2);
    wishes.move((event.clientX - was.x) / 2, (event.clientY - was.y) / 2);
  }

  const released = (event: PointerEvent): void => {
    if (!held.delete(event.pointerId) || held.size) return;
    if (event.type !== "pointerup") return;
    if (slipped < STILL) wishes.clicked(event);
    else if (!moving && event.timeStamp - pace.at < LATE) wishes.flung(pace.right, pace.down);
  };
  view.addEventListener("pointerup", released);
  view.addEventListener("pointercancel", released);
  view.addEventListener("contextmenu", (event) => event.preventDefault());
  view.addEventListener("wheel", (event) => {
    event.preventDefault();
    wishes.taken();
    const box = view.getBoundingClientRect();
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 18 : 1;
    const factor = Math.exp(-Math.max(-240, Math.min(240, event.deltaY * lines)) * (event.ctrlKey ? 0.012 : 0.0022)); // ctrl: a pinch on a touchpad
    wishes.near(factor, event.clientX - box.left - box.width / 2, event.clientY - box.top - box.height / 2);
  }, { passive: false });
}
