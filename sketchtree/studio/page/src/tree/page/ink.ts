// How does the drawing lie on the tree? Its strokes as thin lines on the plane of the page each was drawn on, fading as that page is seen from its edge.

import { Group, Vector2, type BufferGeometry, type Mesh, type Scene, type ShaderMaterial } from "three";
import { isScribble } from "../../draw/trunk/scribbles";
import type { Stroke } from "../../messages";
import { thinLines } from "./line";
import { shortest } from "../eye/eye";
import { onPage, type PagePlane } from "./plane";

type Inked = "branch" | "crown" | "obstacle"; // what is scribbled on a photo has no place in space

const COLOURS: Record<"light" | "dark", Record<Inked, string>> = {
  light: { branch: "#23251f", crown: "#3f7d55", obstacle: "#6d6a86" },
  dark: { branch: "#f2f0ea", crown: "#8fce9f", obstacle: "#b1add0" },
};
const CASING = { light: "#fbf9f4", dark: "#1d2122" };
const STRENGTH = 0.72;
const FAINT = 0.1; // of it, from the page's edge
const FADES = 9; // a power: from its own side a drawing lies on the tree; from a little beside, the tree is what one looks at

interface Sheet {
  view: number; // degrees
  kind: Inked;
  strokes: Stroke[]; // of which it was made
  lines: Mesh<BufferGeometry, ShaderMaterial>;
}

export class Ink {
  private readonly group = new Group();
  private sheets = new Map<string, Sheet>(); // by kind and page
  private at = ""; // where the pages were
  private theme: "light" | "dark" = "light";
  private readonly size = { value: new Vector2(1, 1) };

  constructor(scene: Scene) {
    scene.add(this.group);
  }

  show(strokes: Iterable<Stroke>, plane: PagePlane): void {
    const wanted = bySheet(strokes);
    const at = `${plane.scale} ${plane.root.join(" ")}`;
    for (const [name, sheet] of this.sheets) if (at !== this.at || !sameStrokes(sheet.strokes, wanted.get(name) ?? [])) this.drop(name, sheet);
    this.at = at;
    for (const [name, own] of wanted) if (!this.sheets.has(name)) this.add(name, own, plane);
    this.wear(this.theme);
  }

  private add(name: string, strokes: Stroke[], plane: PagePlane): void {
    const { kind, view_deg: view } = strokes[0]!;
    if (!isInked(kind)) return;
    const lines = thinLines(segments(strokes, plane), kind === "branch" ? 1.6 : 1.3, this.size);
    lines.renderOrder = kind === "branch" ? 6 : 5;
    this.group.add(lines);
    this.sheets.set(name, { view, kind, strokes, lines });
  }

  private drop(name: string, { lines }: Sheet): void {
    this.group.remove(lines);
    lines.geometry.dispose();
    lines.material.dispose();
    this.sheets.delete(name);
  }

  wear(theme: "light" | "dark"): void {
    this.theme = theme;
    for (const { kind, lines } of this.sheets.values()) {
      lines.material.uniforms.uColour!.value.set(COLOURS[theme][kind]);
      lines.material.uniforms.uCasing!.value.set(CASING[theme]);
    }
  }

  /** Seen from this azimuth (degrees), in a view of this size (CSS pixels): a page from its edge is all but gone. */
  seen(azimuth: number, wide: number, high: number): void {
    this.size.value.set(wide, high);
    for (const { view, lines } of this.sheets.values()) {
      const facing = Math.abs(Math.cos(((azimuth - view) * Math.PI) / 180));
      lines.material.uniforms.uOpacity!.value = STRENGTH * (FAINT + (1 - FAINT) * facing ** FADES);
    }
  }

  /** Leave out the sheet of this page; null: none. */
  without(view: number | null): void {
    for (const sheet of this.sheets.values()) sheet.lines.visible = view === null || Math.abs(shortest(sheet.view - view)) > 0.5;
  }

  set visible(is: boolean) {
    this.group.visible = is;
  }
}

function isInked(kind: Stroke["kind"]): kind is Inked {
  return !isScribble({ kind });
}

/** Strokes of a kind and page together. */
export function bySheet(strokes: Iterable<Stroke>): Map<string, Stroke[]> {
  const sheets = new Map<string, Stroke[]>();
  for (const stroke of strokes) {
    if (!isInked(stroke.kind)) continue;
    const name = `${stroke.kind} ${stroke.view_deg}`;
    const own = sheets.get(name);
    if (own) own.push(stroke);
    else sheets.set(name, [stroke]);
  }
  return sheets;
}

/** Strokes are never changed, only put anew: the same objects are the same lines. */
function sameStrokes(had: Stroke[], now: Stroke[]): boolean {
  return had.length === now.length && had.every((stroke, k) => stroke === now[k]);
}

/** x, y, z of both ends of every segment. */
export function segments(strokes: readonly Stroke[], plane: PagePlane): Float32Array {
  const pieces = ({ xy, closed }: Stroke): number => Math.max(0, xy.length / 2 - (closed ? 0 : 1));
  const points = new Float32Array(6 * strokes.reduce((sum, stroke) => sum + pieces(stroke), 0));
  let at = 0;
  for (const stroke of strokes) {
    const { xy, view_deg } = stroke;
    for (let k = 0; k < pieces(stroke); k++, at += 6) {
      const next = (k + 1) % (xy.length / 2);
      points.set(onPage(plane, view_deg, xy[2 * k]!, xy[2 * k + 1]!, 0), at);
      points.set(onPage(plane, view_deg, xy[2 * next]!, xy[2 * next + 1]!, 0), at + 3);
    }
  }
  return points;
}
