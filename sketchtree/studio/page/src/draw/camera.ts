// Which part of the page is on screen? Page units → CSS pixels of the canvas: one scale and one shift. The tree view reads it when the page lies over it.

export interface Frame {
  left: number;
  top: number;
  width: number;
  height: number;
}

const LEAST = 0.02;
const MOST = 40;

export class PageCamera {
  scale = 1; // CSS pixels a page unit
  x = 0; // CSS pixels, from the canvas's left, of the page's origin
  y = 0;
  width = 1; // of the canvas, CSS pixels
  height = 1;
  private head = 0; // CSS pixels of the canvas's top and foot over which something stands
  private foot = 44;
  private fitted: Frame | null = null; // what was shown whole, until a hand moves the page
  private readonly listeners = new Set<() => void>();

  /** Be told when it moves; returns what ends it. */
  on(listener: () => void): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }

  toPage(px: number, py: number): [number, number] {
    return [(px - this.x) / this.scale, (py - this.y) / this.scale];
  }

  toScreen(x: number, y: number): [number, number] {
    return [x * this.scale + this.x, y * this.scale + this.y];
  }

  pan(dx: number, dy: number): void {
    this.place(this.scale, this.x + dx, this.y + dy);
  }

  /** Closer or farther by a factor; the point under (px, py) stays where it is. */
  zoom(factor: number, px: number, py: number): void {
    const scale = Math.min(MOST, Math.max(LEAST, this.scale * factor));
    const real = scale / this.scale;
    this.place(scale, px - (px - this.x) * real, py - (py - this.y) * real);
  }

  /** All of a box of the page, with a margin around it, between what stands at the page's top and foot. */
  fit(box: Frame, margin = 0.06): void {
    const height = Math.max(1, this.height - this.head - this.foot);
    const room = (1 - 2 * margin) * Math.min(this.width / Math.max(box.width, 1e-6), height / Math.max(box.height, 1e-6));
    const scale = Math.min(MOST, Math.max(LEAST, room));
    this.place(scale, this.width / 2 - (box.left + box.width / 2) * scale, this.head + height / 2 - (box.top + box.height / 2) * scale);
    this.fitted = box;
  }

  /** Everything is shown, and no hand has moved the page since. */
  get showsAll(): boolean {
    return this.fitted !== null;
  }

  /** Something stands over the canvas's top, or foot. Where all was shown, and more of it is hidden now, it is shown again; what goes moves nothing. */
  cover(what: "head" | "foot", pixels: number): void {
    const more = pixels > this[what];
    this[what] = pixels;
    if (more && this.fitted) this.fit(this.fitted);
  }

  /** The canvas has another size: what was shown whole still is; else what was in its middle stays there. */
  resize(width: number, height: number): void {
    const dx = (width - this.width) / 2;
    const dy = (height - this.height) / 2;
    const { fitted } = this;
    this.width = width;
    this.height = height;
    if (fitted && width > 1) this.fit(fitted);
    else this.place(this.scale, this.x + dx, this.y + dy);
  }

  private place(scale: number, x: number, y: number): void {
    this.fitted = null;
    this.scale = scale;
    this.x = x;
    this.y = y;
    this.listeners.forEach((listener) => listener());
  }
}

/** The page's one camera. */
export const camera = new PageCamera();
