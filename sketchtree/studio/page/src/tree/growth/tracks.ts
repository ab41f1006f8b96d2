// What is the value of each track at a moment? Keys with straight lines between them, turns on the shorter arc; all tracks of a kind lie in one array.

export interface Tracks {
  width: 3 | 4; // 4: quaternions
  target: Int32Array; // the row that each track moves
  start: Int32Array; // its first key; one more than there are tracks
  time: Float32Array; // seconds, rising within a track
  value: Float32Array; // `width` a key
}

/** Tracks out of (row, times, values) each. */
export function tracksOf(width: 3 | 4, all: { target: number; time: Float32Array; value: Float32Array }[]): Tracks {
  const start = new Int32Array(all.length + 1);
  all.forEach(({ time }, k) => { start[k + 1] = start[k]! + time.length; });
  const tracks: Tracks = { width, target: Int32Array.from(all, (one) => one.target), start, time: new Float32Array(start[all.length]!), value: new Float32Array(width * start[all.length]!) };
  all.forEach(({ time, value }, k) => {
    tracks.time.set(time, start[k]!);
    tracks.value.set(value, width * start[k]!);
  });
  return tracks;
}

/** Puts each track's value into its row of `into`, `width` a row; rows without a track stay. */
export function sample({ width, target, start, time, value }: Tracks, second: number, into: Float32Array): void {
  for (let track = 0; track < target.length; track++) {
    const last = start[track + 1]! - 1;
    const key = before(time, start[track]!, last, second);
    const next = Math.min(key + 1, last);
    const span = time[next]! - time[key]!;
    const share = span > 0 ? Math.min(1, Math.max(0, (second - time[key]!) / span)) : 0;
    if (width === 4) turn(value, 4 * key, 4 * next, share, into, 4 * target[track]!);
    else for (let k = 0; k < 3; k++) into[3 * target[track]! + k] = value[3 * key + k]! + share * (value[3 * next + k]! - value[3 * key + k]!);
  }
}

/** The last key, of `low` to `high`, that is not after the moment; the first if all are. */
export function before(time: Float32Array, low: number, high: number, second: number): number {
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (time[middle]! <= second) low = middle;
    else high = middle - 1;
  }
  return low;
}

function turn(value: Float32Array, a: number, b: number, share: number, into: Float32Array, at: number): void {
  const dot = value[a]! * value[b]! + value[a + 1]! * value[b + 1]! + value[a + 2]! * value[b + 2]! + value[a + 3]! * value[b + 3]!;
  const angle = Math.acos(Math.min(1, Math.abs(dot)));
  const whole = Math.sin(angle);
  const near = whole < 1e-4; // a straight line is as good there
  const from = near ? 1 - share : Math.sin((1 - share) * angle) / whole;
  const to = (near ? share : Math.sin(share * angle) / whole) * (dot < 0 ? -1 : 1);
  let long = 0;
  for (let k = 0; k < 4; k++) {
    const mixed = from * value[a + k]! + to * value[b + k]!;
    into[at + k] = mixed;
    long += mixed * mixed;
  }
  long = Math.sqrt(long) || 1;
  for (let k = 0; k < 4; k++) into[at + k]! /= long;
}
