import { describe, expect, it } from "vitest";
import { movingGroups } from "../src/panel/dialogs/export_growth";
import { blocked, changed, fitting, USUAL } from "../src/panel/dialogs/export_options";
import { projectName } from "../src/panel/dialogs/project_name";

describe("options of export", () => {
  it("all go together as usual", () => {
    expect(blocked(USUAL)).toEqual({});
  });

  it("know that a game pack has its own levels and leaves", () => {
    expect(Object.keys(blocked({ ...USUAL, pack: "game" })).sort()).toEqual(["leaves", "levels", "lod"]);
    expect(changed({ ...USUAL, lod: 2 }, { pack: "game" })).toEqual({ ...USUAL, pack: "game" });
  });

  it("take a level back where all are written", () => {
    expect(changed({ ...USUAL, lod: 2 }, { levels: "together" })).toEqual({ ...USUAL, levels: "together" });
  });

  it("merge the leaves of coarser levels", () => {
    expect(changed({ ...USUAL, leaves: "instanced" }, { lod: 1 })).toEqual({ ...USUAL, lod: 1 });
  });

  it("leave out what a format has no place for", () => {
    const all = { ...USUAL, levels: "together", leaves: "instanced", solid: true } as const;
    expect(fitting(all, ".glb")).toEqual(all);
    expect(fitting(all, ".stl")).toEqual({ ...USUAL, solid: true });
    expect(fitting(all, ".swc")).toEqual(USUAL);
  });
});

describe("what is exported of a growth", () => {
  it("is files that move, and films that this machine can make", () => {
    const of = (...names: string[]) => movingGroups(names.map((name) => ({ name, title: name, picture: null }))).map(({ title, formats }) => [title, ...formats.map(({ format }) => format.name)]);
    expect(of(".glb", ".usdz", ".mp4", ".gif")).toEqual([["A tree that grows", ".glb", ".usdz"], ["A film of its growth", ".mp4", ".gif"]]);
    expect(of(".glb")).toEqual([["A tree that grows", ".glb"]]);
  });
});

describe("a project's name", () => {
  it("gets its extension once", () => {
    expect(projectName(" old oak ")).toEqual({ name: "old oak.sketchtree" });
    expect(projectName("old oak.SketchTree")).toEqual({ name: "old oak.sketchtree" });
  });

  it("says what is wrong with it", () => {
    for (const wrong of ["", " ", "../x", "a\\b", "a\nb", ".hidden", "x".repeat(200)]) expect(projectName(wrong)).toHaveProperty("wrong");
  });
});
