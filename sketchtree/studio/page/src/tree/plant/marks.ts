// Which colour is laid over each limb? One texel a limb: colour and strength. Hover and choice change a texel, never the mesh.

import { DataTexture, NearestFilter, RGBAFormat, UnsignedByteType } from "three";

const WIDTH = 256; // texels a row; the shader of the wood knows it too

export type Mark = readonly [red: number, green: number, blue: number, strength: number]; // of 255, linear

export class Marks {
  readonly uniform: { value: DataTexture } = { value: texels(1) };
  private limbs: readonly string[] = [];
  private number: ReadonlyMap<string, number> = new Map();

  /** Other limbs: all marks go. */
  renumber(limbs: readonly string[], number: ReadonlyMap<string, number>): void {
    this.limbs = limbs;
    this.number = number;
    const rows = Math.max(1, Math.ceil(limbs.length / WIDTH));
    if (this.uniform.value.image.height < rows) {
      this.uniform.value.dispose();
      this.uniform.value = texels(rows);
    }
    this.clear();
  }

  clear(): void {
    this.data.fill(0);
    this.uniform.value.needsUpdate = true;
  }

  /** Lay a colour over one limb; an id that is not there is let be. */
  set(id: string, mark: Mark): void {
    const number = this.number.get(id);
    if (number === undefined) return;
    this.data.set(mark, 4 * number);
    this.uniform.value.needsUpdate = true;
  }

  id(number: number): string | undefined {
    return this.limbs[number];
  }

  private get data(): Uint8Array {
    return this.uniform.value.image.data as Uint8Array;
  }
}

function texels(rows: number): DataTexture {
  const texture = new DataTexture(new Uint8Array(4 * WIDTH * rows), WIDTH, rows, RGBAFormat, UnsignedByteType);
  texture.minFilter = texture.magFilter = NearestFilter;
  return texture;
}

/** For the vertex shader: the mark of the limb with this number. */
export const MARK_OF = `vec4 markOf(float limb) { int k = int(limb + 0.5); return texelFetch(uMarks, ivec2(k % ${WIDTH}, k / ${WIDTH}), 0); }`;
