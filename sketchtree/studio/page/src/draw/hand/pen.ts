// Who is touching the page, and what for? Pen, mouse and fingers are told apart here: one of them draws, two fingers move the page, a palm does nothing.
//
// Rules    a pen was seen: fingers move the page and never draw      a contact as large as a palm is none      a second finger soon after the first takes back
//          what the first began      the middle button, or any with the space bar, moves the page; the right one turns it, and on a photo draws a branch, or the other of two scribbles      an event told twice counts once

import type { Desk } from "../desk";
import { Fingers } from "./fingers";
import type { Tool, Touch } from "./touch";
import { turning } from "./turning";

const PALM = 60; // CSS pixels across
const TAKE_BACK = 250; // ms in which a second finger undoes what the first began
const ERASER_BUTTON = 32; // of a pen turned over

export interface PenTools {
  current: () => Tool;
  eraser: Tool;
  panning: Tool;
  second: () => Tool | null; // that the right button is for now; null: it turns the page
}

export class Pen {
  private held: { pointer: number; tool: Tool; since: number; type: string; last: Touch } | null = null;
  private readonly fingers: Fingers;
  private readonly turning: Tool;
  private space = false;

  constructor(private readonly canvas: HTMLCanvasElement, private readonly desk: Desk, private readonly tools: PenTools) {
    this.fingers = new Fingers(desk.camera);
    this.turning = turning(desk);
    canvas.addEventListener("pointerdown", (event) => this.down(event));
    canvas.addEventListener("pointermove", (event) => this.move(event));
    canvas.addEventListener("pointerup", (event) => this.up(event));
    canvas.addEventListener("pointercancel", (event) => this.lost(event));
    canvas.addEventListener("pointerleave", () => { if (!this.held) this.tools.current().hover(null); });
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    addEventListener("blur", () => { this.setSpace(false); });
  }

  /** The space bar is held: whatever draws moves the page. */
  setSpace(is: boolean): void {
    this.space = is;
    this.showCursor();
  }

  showCursor(): void {
    const tool = this.held?.tool ?? (this.space ? this.tools.panning : this.tools.current());
    this.canvas.style.cursor = (this.held && tool.held) || tool.cursor;
  }

  /** Whatever is in hand is let go, and nothing comes of it. */
  cancel(): void {
    this.held?.tool.cancel();
    this.held = null;
    this.showCursor();
  }

  get busy(): boolean {
    return this.held !== null;
  }

  private down(event: PointerEvent): void {
    const { store } = this.desk;
    this.canvas.focus({ preventScroll: true });
    if (event.pointerType === "pen") {
      store.set("palm", true);
      if (this.held?.type === "touch") this.cancel(); // the hand that holds the pen came first
    }
    if (event.pointerType === "touch" && this.takesFinger(event)) return;
    if (this.held) return; // told twice, or another button of the same mouse
    this.hold(event, this.toolFor(event));
  }

  private hold(event: PointerEvent, tool: Tool): void {
    event.preventDefault();
    capture(this.canvas, event.pointerId);
    const at = this.touch(event);
    this.held = { pointer: event.pointerId, tool, since: event.timeStamp, type: event.pointerType, last: at };
    tool.down(at);
    this.showCursor();
  }

  /** Whether a finger does something other than draw: move the page with a second one, or nothing. */
  private takesFinger(event: PointerEvent): boolean {
    if (Math.max(event.width, event.height) > PALM || this.held?.type === "pen") return true;
    this.fingers.down(event.pointerId, ...this.at(event));
    if (this.fingers.count < 2) {
      if (!this.desk.store.ui.palm) return false;
      capture(this.canvas, event.pointerId);
      return true;
    }
    if (this.held?.type === "touch" && event.timeStamp - this.held.since > TAKE_BACK) return true; // a line well begun goes on
    this.cancel();
    capture(this.canvas, event.pointerId);
    return true;
  }

  private toolFor(event: PointerEvent): Tool {
    if (event.button === 1 || this.space) return this.tools.panning;
    if (event.button === 2) return event.pointerType === "pen" ? this.tools.panning : (this.tools.second() ?? this.turning); // a pen's side button
    if (event.buttons & ERASER_BUTTON) return this.tools.eraser;
    return this.tools.current();
  }

  private move(event: PointerEvent): void {
    if (event.pointerType === "touch") {
      const moves = this.held === null;
      if (this.fingers.move(event.pointerId, ...this.at(event), moves) && moves) return;
    }
    if (!this.held) {
      if (event.pointerType === "touch") return;
      this.tools.current().hover(this.touch(event));
      return this.showCursor();
    }
    if (event.pointerId !== this.held.pointer) return;
    if (event.pointerType === "mouse" && event.buttons === 0) return this.up(event); // it was let go outside the window
    const told = event.getCoalescedEvents?.() ?? [];
    const fresh = (told.length ? told : [event]).map((one) => this.touch(one));
    this.held.last = fresh[fresh.length - 1]!;
    this.held.tool.move(fresh, (event.getPredictedEvents?.() ?? []).map((one) => this.touch(one)));
    this.showCursor();
  }

  private up(event: PointerEvent): void {
    this.fingers.up(event.pointerId);
    if (event.pointerId !== this.held?.pointer) return;
    const { tool } = this.held;
    this.held = null;
    tool.up(this.touch(event));
    this.showCursor();
  }

  /** The system took the pointer (a gesture of its own): what was drawn so far counts, but for a finger, whose gesture it was. */
  private lost(event: PointerEvent): void {
    this.fingers.up(event.pointerId);
    if (event.pointerId !== this.held?.pointer) return;
    if (event.pointerType === "touch") return this.cancel();
    const { tool, last } = this.held; // where such an event says it is means nothing
    this.held = null;
    tool.up(last);
    this.showCursor();
  }

  private at(event: PointerEvent): [number, number] {
    const box = this.canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  private touch(event: PointerEvent): Touch {
    const [px, py] = this.at(event);
    const [x, y] = this.desk.camera.toPage(px, py);
    const pen = event.pointerType === "pen";
    return { x, y, px, py, pressure: pen ? event.pressure : 0.5, time: event.timeStamp, pen, alt: event.altKey, shift: event.shiftKey };
  }
}

/** A pointer that is gone already cannot be captured; that is no error. */
function capture(canvas: HTMLCanvasElement, pointer: number): void {
  try {
    canvas.setPointerCapture(pointer);
  } catch {
    // it was lifted between the event and now
  }
}
