import { describe, expect, it } from "vitest";
import { answers, rank } from "../src/panel/strip/ranking";

const choice = (name: string, title: string) => ({ name, title, picture: null });
const all = [choice("apple", "Orchard apple"), choice("oak", "English oak"), choice("elm", "American elm"), choice("genevrier", "Genévrier nain")];

describe("the order of the templates", () => {
  it("is that of the matches, and the rest follow by title", () => {
    const ranked = rank(all, [{ name: "oak", score: -1, view_deg: 0 }, { name: "elm", score: -5, view_deg: 0 }]);
    expect(ranked.map((one) => one.choice.name)).toEqual(["oak", "elm", "genevrier", "apple"]);
  });

  it("gives the best a full bar, the worst none, and what was not compared no bar at all", () => {
    const ranked = rank(all, [{ name: "oak", score: -1, view_deg: 0 }, { name: "apple", score: -2, view_deg: 0 }, { name: "elm", score: -5, view_deg: 0 }]);
    expect(ranked.map((one) => one.bar)).toEqual([1, 0.75, 0, null]);
  });

  it("is by title before anything was drawn", () => {
    expect(rank(all, []).map((one) => one.choice.title)).toEqual(["American elm", "English oak", "Genévrier nain", "Orchard apple"]);
  });

  it("gives a full bar where all are alike", () => {
    expect(rank(all, [{ name: "oak", score: 3, view_deg: 0 }])[0]!.bar).toBe(1);
  });
});

describe("a search", () => {
  it("takes any case, any order of words, and letters without their accents", () => {
    expect(answers(all[1]!, "OAK eng")).toBe(true);
    expect(answers(all[3]!, "genevrier")).toBe(true);
    expect(answers(all[0]!, "oak")).toBe(false);
  });

  it("for nothing finds everything", () => {
    expect(all.every((one) => answers(one, "  "))).toBe(true);
  });
});
