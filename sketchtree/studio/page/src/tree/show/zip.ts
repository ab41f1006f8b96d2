// How do several files become one? A ZIP archive that packs nothing: pictures are packed already. (PKWARE's APPNOTE 6.3, entries stored, sizes below 4 GB.)

export interface ZipFile {
  name: string;
  data: Uint8Array<ArrayBuffer>;
}

const DAY = 0x21; // 1 January 1980: archives of the same files are the same

export function zipped(files: readonly ZipFile[]): Blob {
  const parts: Uint8Array<ArrayBuffer>[] = [];
  const index: Uint8Array<ArrayBuffer>[] = [];
  let at = 0;
  for (const { name, data } of files) {
    const title = new TextEncoder().encode(name);
    const about = [10, 0x800, 0, 0, DAY] as const; // version, names are UTF-8, stored, time, day
    const sizes = [crc32(data), data.length, data.length] as const;
    const local = record(0x04034b50, [...about.map(two), ...sizes.map(four), two(title.length), two(0)], title);
    index.push(record(0x02014b50, [two(10), ...about.map(two), ...sizes.map(four), two(title.length), two(0), two(0), two(0), two(0), four(0), four(at)], title));
    parts.push(local, data);
    at += local.length + data.length;
  }
  const long = index.reduce((sum, entry) => sum + entry.length, 0);
  const end = record(0x06054b50, [two(0), two(0), two(files.length), two(files.length), four(long), four(at), two(0)], new Uint8Array());
  return new Blob([...parts, ...index, end], { type: "application/zip" });
}

type Field = readonly [value: number, bytes: 2 | 4];
const two = (value: number): Field => [value, 2];
const four = (value: number): Field => [value, 4];

function record(mark: number, fields: readonly Field[], rest: Uint8Array): Uint8Array<ArrayBuffer> {
  const long = fields.reduce((sum, [, bytes]) => sum + bytes, 4);
  const made = new Uint8Array(long + rest.length);
  const view = new DataView(made.buffer);
  view.setUint32(0, mark, true);
  let at = 4;
  for (const [value, bytes] of fields) {
    if (bytes === 2) view.setUint16(at, value, true);
    else view.setUint32(at, value, true);
    at += bytes;
  }
  made.set(rest, at);
  return made;
}

const TABLE = Uint32Array.from({ length: 256 }, (_, k) => {
  for (let bit = 0; bit < 8; bit++) k = k & 1 ? 0xedb88320 ^ (k >>> 1) : k >>> 1;
  return k;
});

export function crc32(data: Uint8Array): number {
  let sum = 0xffffffff;
  for (const byte of data) sum = TABLE[(sum ^ byte) & 255]! ^ (sum >>> 8);
  return (sum ^ 0xffffffff) >>> 0;
}
