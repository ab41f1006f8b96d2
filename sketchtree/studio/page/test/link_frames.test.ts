import { describe, expect, test } from "vitest";
import { readFrame } from "../src/link/frames";

function frame(head: object, body: ArrayBuffer): ArrayBuffer {
  const text = new TextEncoder().encode(JSON.stringify(head));
  const start = Math.ceil((4 + text.length) / 8) * 8;
  const bytes = new Uint8Array(start + body.byteLength);
  new DataView(bytes.buffer).setUint32(0, text.length, true);
  bytes.set(text, 4);
  bytes.set(new Uint8Array(body), start);
  return bytes.buffer;
}

describe("a binary frame", () => {
  const body = new ArrayBuffer(48);
  new Float32Array(body, 0, 6).set([1, 2, 3, 4, 5, 6]);
  new Uint32Array(body, 24, 3).set([0, 1, 2]);
  new Int16Array(body, 40, 2).set([-5, 32767]);
  const arrays = [
    { name: "position", dtype: "f4", shape: [2, 3], offset: 0 }, { name: "index", dtype: "u4", shape: [3], offset: 24 },
    { name: "turn", dtype: "i2", shape: [2], offset: 40 }, { name: "none", dtype: "u1", shape: [0, 4], offset: 48 },
  ];

  for (const padding of [0, 1, 2, 3, 4, 5, 6, 7]) {
    test(`gives its arrays by name, whatever the length of its head (+${padding})`, () => {
      const { head, arrays: read } = readFrame(frame({ type: "tree", filler: "x".repeat(padding), arrays }, body));
      expect(head.type).toBe("tree");
      expect([...read.get("position")!]).toEqual([1, 2, 3, 4, 5, 6]);
      expect([...read.get("index")!]).toEqual([0, 1, 2]);
      expect([...read.get("turn")!]).toEqual([-5, 32767]);
      expect(read.get("none")).toHaveLength(0);
    });
  }

  test("is not copied", () => {
    const data = frame({ type: "ghost", arrays }, body);
    for (const array of readFrame(data).arrays.values()) expect(array.buffer).toBe(data);
  });
});
