// How does the drawing lie on the tree? Its strokes as thin lines on the plane of the page each was drawn on, fading as that page is seen from its edge.

import { Group, Vector2, type BufferGeometry, type Mesh, type Scene, type ShaderMaterial } from "three";
import type { Stroke } from "../../messages";
import { thinLines } from "./line";
import { shortest } from "../eye/eye";
import { onPage, type PagePlane } from "./plane";

const COLOURS: Record<"light" | "dark", Record<Stroke["kind"], string>> = {
  light: { branch: "#23251f", crown: "#3f7d55", obstacle: "#6d6a86" },
  dark: { branch: "#f2f0ea", crown: "#8fce9f", obstacle: "#b1add0" },
};
const STRENGTH = 0.55;

interface Sheet {
  view: number; // degrees
  kind: Stroke["kind"];
  lines: Mesh<BufferGeometry, ShaderMaterial>;
}

export class Ink {
  private readonly group = new Group();
  private sheets: Sheet[] = [];
  private theme: "light" | "dark" = "light";
  private readonly size = { value: new Vector2(1, 1) };

  constructor(scene: Scene) {
    scene.add(this.group);
  }

  show(strokes: Iterable<Stroke>, plane: PagePlane): void {
    for (const { lines } of this.sheets) [lines.geometry, lines.material].forEach((part) => part.dispose());
    this.group.clear();
    const sheets = new Map<string, { view: number; kind: Stroke["kind"]; points: number[] }>();
    for (const stroke of strokes) {
      const name = `${stroke.kind} ${stroke.view_deg}`;
      if (!sheets.has(name)) sheets.set(name, { view: stroke.view_deg, kind: stroke.kind, points: [] });
      segments(stroke, plane, sheets.get(name)!.points);
    }
    this.sheets = [...sheets.values()].filter((sheet) => sheet.points.length).map(({ view, kind, points }) => {
      const lines = thinLines(points, kind === "branch" ? 1.6 : 1.3, this.size);
      lines.renderOrder = 5;
      this.group.add(lines);
      return { view, kind, lines };
    });
    this.wear(this.theme);
  }

  wear(theme: "light" | "dark"): void {
    this.theme = theme;
    for (const { kind, lines } of this.sheets) lines.material.uniforms.uColour!.value.set(COLOURS[theme][kind]);
  }

  /** Seen from this azimuth (degrees), in a view of this size (CSS pixels): a page from its edge is all but gone. */
  seen(azimuth: number, wide: number, high: number): void {
    this.size.value.set(wide, high);
    for (const { view, lines } of this.sheets) {
      const facing = Math.abs(Math.cos(((azimuth - view) * Math.PI) / 180));
      lines.material.uniforms.uOpacity!.value = STRENGTH * (0.12 + 0.88 * facing * facing);
    }
  }

  /** Leave out the sheet of this page; null: none. */
  without(view: number | null): void {
    for (const sheet of this.sheets) sheet.lines.visible = view === null || Math.abs(shortest(sheet.view - view)) > 0.5;
  }

  set visible(is: boolean) {
    this.group.visible = is;
  }
}

function segments({ xy, closed, view_deg }: Stroke, plane: PagePlane, into: number[]): void {
  const count = xy.length / 2;
  for (let k = 0; k + 1 < count + (closed ? 1 : 0); k++) {
    const next = (k + 1) % count;
    into.push(...onPage(plane, view_deg, xy[2 * k]!, xy[2 * k + 1]!, 0), ...onPage(plane, view_deg, xy[2 * next]!, xy[2 * next + 1]!, 0));
  }
}
