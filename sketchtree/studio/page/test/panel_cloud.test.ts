import { describe, expect, test } from "vitest";
import { reading } from "../src/panel/dialogs/cloud_words";

describe("how points are to be read", () => {
  test("says an axis and a unit", () => {
    expect(reading({ up: "auto", unit: "m", height: "" })).toEqual({ reading: { up: "auto", unit: 1 } });
    expect(reading({ up: "z", unit: "mm", height: "7" })).toEqual({ reading: { up: "z", unit: 0.001 } });
  });
  test("or how high the plant is", () => {
    expect(reading({ up: "y", unit: "height", height: " 2.5 " })).toEqual({ reading: { up: "y", height: 2.5 } });
  });
  test("a height that is none is named, with what can be read", () => {
    expect(reading({ up: "y", unit: "height", height: " " })).toEqual({ wrong: "How high is the plant? Give metres." });
    expect(reading({ up: "y", unit: "height", height: "200" })).toEqual({ wrong: "A plant of 200 m is out of range: 0.05 to 150 m can be read." });
  });
});
