// How is a binary frame read? A head in JSON, then arrays, each seen where it lies: nothing is copied.
//
//     uint32 little-endian: length of the head │ the head │ zeros up to a multiple of 8 │ the arrays

import type { Array as ArrayHead, Ghost, Tree } from "../messages";
import type { Arrays } from "../store";

const VIEWS = { f4: Float32Array, u4: Uint32Array, u2: Uint16Array, u1: Uint8Array, i2: Int16Array, i1: Int8Array };
const ALIGNMENT = 8;

export function readFrame(data: ArrayBuffer): { head: Tree | Ghost; arrays: Arrays } {
  const length = new DataView(data).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, length))) as Tree | Ghost;
  const start = Math.ceil((4 + length) / ALIGNMENT) * ALIGNMENT;
  const arrays: Arrays = new Map();
  for (const array of head.arrays) arrays.set(array.name, view(data, start, array));
  return { head, arrays };
}

function view(data: ArrayBuffer, start: number, array: ArrayHead): Float32Array | Uint32Array | Uint16Array | Uint8Array | Int16Array | Int8Array {
  const count = array.shape.reduce((product, side) => product * side, 1);
  return new VIEWS[array.dtype](data, start + array.offset, count);
}
