import { expect, it } from "vitest";
import { bytes, count, counted, duration, metres, percent, plain } from "../src/panel/figures";

it("parts the thousands", () => {
  expect([0, 999, 1000, 1234567].map(count)).toEqual(["0", "999", "1\u202f000", "1\u202f234\u202f567"]);
});

it("knows one from many", () => {
  expect([counted(1, "leaf", "leaves"), counted(0, "leaf", "leaves")]).toEqual(["1 leaf", "0 leaves"]);
});

it("writes no digit that says nothing", () => {
  expect([plain(3.5), plain(2), plain(0.125, 2)]).toEqual(["3.5", "2", "0.13"]);
});

it("measures small trees in centimetres", () => {
  expect([0.42, 0.999, 8.24, 120.4].map(metres)).toEqual(["42 cm", "1 m", "8.2 m", "120 m"]);
});

it("tells times and sizes in the unit that fits", () => {
  expect([84.4, 1340].map(duration)).toEqual(["84 ms", "1.3 s"]);
  expect([512, 412_300, 999_700, 3_440_000, 34_400_000].map(bytes)).toEqual(["512 bytes", "412 kB", "1 MB", "3.4 MB", "34 MB"]);
});

it("does not call the improbable impossible", () => {
  expect([0, 0.001, 0.624, 1].map(percent)).toEqual(["0 %", "under 1 %", "62 %", "100 %"]);
});
