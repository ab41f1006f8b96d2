import { describe, expect, it } from "vitest";
import { PageCamera } from "../src/draw/camera";
import { isOpened } from "../src/draw/following";
import { commonName } from "../src/panel/strip/ranking";
import { bySheet, segments } from "../src/tree/page/ink";
import type { Stroke } from "../src/messages";

const BOX = { left: 0, top: 0, width: 100, height: 200 };

function screen(): PageCamera {
  const camera = new PageCamera();
  camera.resize(400, 500);
  return camera;
}

describe("a drawing that is shown whole", () => {
  it("stays above the controls at the foot, and below what is said at the top", () => {
    const camera = screen();
    camera.cover("foot", 60);
    camera.cover("head", 50);
    camera.fit(BOX);
    expect(camera.toScreen(0, 0)[1]).toBeGreaterThan(50);
    expect(camera.toScreen(0, 200)[1]).toBeLessThan(440);
  });

  it("is shown whole again when more of the page is covered, or the window is smaller", () => {
    const camera = screen();
    camera.fit(BOX);
    camera.cover("head", 120);
    expect(camera.toScreen(0, 0)[1]).toBeGreaterThan(120);
    camera.resize(400, 300);
    expect(camera.toScreen(0, 200)[1]).toBeLessThan(300);
  });

  it("does not move when something goes away, nor after a hand moved the page", () => {
    const camera = screen();
    camera.cover("head", 120);
    camera.fit(BOX);
    const before = camera.toScreen(0, 0);
    camera.cover("head", 0);
    expect(camera.toScreen(0, 0)).toEqual(before);
    camera.pan(7, 0);
    camera.cover("head", 200);
    expect(camera.toScreen(0, 0)).toEqual([before[0] + 7, before[1]]);
  });
});

describe("a drawing was opened", () => {
  it("when all its strokes came at once, some perhaps still on their way to the program", () => {
    expect(isOpened(new Set(), ["a", "b"], false)).toBe(true);
    expect(isOpened(new Set(), ["a", "b"], true)).toBe(true);
  });

  it("not when a stroke was drawn, nor while one that was there is still there", () => {
    expect(isOpened(new Set(), ["a"], true)).toBe(false);
    expect(isOpened(new Set(["a"]), ["b", "c"], true)).toBe(false);
    expect(isOpened(new Set(["a"]), ["a", "b"], false)).toBe(false);
    expect(isOpened(new Set(["a"]), [], false)).toBe(false);
  });
});

describe("the drawing on the tree", () => {
  const stroke = (id: string, view_deg: number, xy: number[], closed = false): Stroke => ({ id, kind: "branch", view_deg, xy, closed }) as Stroke;
  const plane = { scale: 0.5, root: [10, 20] };

  it("has a sheet for each page and kind", () => {
    const sheets = bySheet([stroke("a", 0, [0, 0, 1, 1]), stroke("b", 90, [0, 0, 1, 1]), stroke("c", 0, [0, 0, 1, 1])]);
    expect([...sheets.values()].map((own) => own.map((one) => one.id))).toEqual([["a", "c"], ["b"]]);
  });

  it("is both ends of each segment in metres, and closed lines come back to where they began", () => {
    expect([...segments([stroke("a", 0, [10, 20, 12, 16])], plane)]).toEqual([0, 0, -0, 1, 2, -0].map((v) => v + 0));
    expect(segments([stroke("a", 0, [0, 0, 1, 0, 1, 1], true), stroke("b", 0, [5, 5])], plane).length).toBe(18);
  });
});

describe("a template's name on its card", () => {
  it("is the common one", () => {
    expect(commonName("English oak (Quercus robur)")).toBe("English oak");
    expect(commonName("Bonsai: juniper, cascade")).toBe("Bonsai: juniper, cascade");
  });
});
