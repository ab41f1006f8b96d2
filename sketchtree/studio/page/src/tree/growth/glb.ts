// What is in a GLB? Its JSON, and the arrays that its accessors name. Only what our own files have: one buffer, tightly packed columns.

export interface Accessor { bufferView: number; byteOffset?: number; componentType: number; count: number; type: string; normalized?: boolean }
export interface Primitive { attributes: Record<string, number>; indices: number; material: number; targets?: { POSITION: number }[] }
export interface Node { name?: string; mesh?: number; children?: number[]; translation?: number[]; rotation?: number[]; scale?: number[] }
export interface Channel { sampler: number; target: { node: number; path: "translation" | "rotation" | "scale" | "weights" } }

export interface Gltf {
  nodes: Node[];
  meshes: { primitives: Primitive[] }[];
  materials: { name: string }[];
  skins: { joints: number[]; inverseBindMatrices: number }[];
  animations: { channels: Channel[]; samplers: { input: number; output: number }[] }[];
  accessors: Accessor[];
  bufferViews: { byteOffset?: number; byteStride?: number }[];
}

export type Column = Float32Array | Uint32Array | Uint16Array | Uint8Array | Int16Array | Int8Array;

const KINDS = { 5120: Int8Array, 5121: Uint8Array, 5122: Int16Array, 5123: Uint16Array, 5125: Uint32Array, 5126: Float32Array } as const;
const WIDTHS: Record<string, number> = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4, MAT4: 16 };
const [GLTF, JSON_CHUNK, HEAD] = [0x46546c67, 0x4e4f534a, 20];

export class Glb {
  readonly json: Gltf;
  private readonly binary: number; // where the arrays begin

  /** Throws where these bytes are no GLB. */
  constructor(private readonly bytes: ArrayBuffer) {
    const words = new DataView(bytes);
    if (bytes.byteLength < HEAD || words.getUint32(0, true) !== GLTF || words.getUint32(16, true) !== JSON_CHUNK) throw new Error("The growth that came is no GLB.");
    const long = words.getUint32(12, true);
    if (words.getUint32(8, true) > bytes.byteLength) throw new Error("The growth that came is cut short.");
    this.json = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, HEAD, long))) as Gltf;
    this.binary = HEAD + long + 8;
  }

  /** The array of an accessor, copied: the file's own memory may go. */
  column(number: number): Column {
    const { bufferView, byteOffset = 0, componentType, count, type } = this.json.accessors[number]!;
    const view = this.json.bufferViews[bufferView]!;
    const [kind, width] = [KINDS[componentType as keyof typeof KINDS], WIDTHS[type]!];
    const [from, row] = [this.binary + (view.byteOffset ?? 0) + byteOffset, width * kind.BYTES_PER_ELEMENT];
    if ((view.byteStride ?? row) !== row) throw new Error(`Array ${number} of the growth is not packed.`);
    return new kind(this.bytes.slice(from, from + count * row));
  }

  floats(number: number): Float32Array {
    const found = this.column(number);
    if (!(found instanceof Float32Array)) throw new Error(`Array ${number} of the growth holds no floats.`);
    return found;
  }
}
