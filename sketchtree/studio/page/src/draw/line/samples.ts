// Where was the pen, really? Browsers deliver its events doubled, out of order and in bursts; a line takes each once, by its time.

export interface Sample {
  x: number; // page units
  y: number;
  pressure: number; // 0-1
  time: number; // ms
}

/** Put new samples into a line kept in order of time. Two at the same time are one, the last told. Mutates `line`. */
export function insert(line: Sample[], fresh: Sample[]): void {
  for (const sample of fresh) {
    if (![sample.x, sample.y, sample.pressure, sample.time].every(Number.isFinite)) continue;
    let at = line.length;
    while (at > 0 && line[at - 1]!.time > sample.time) at -= 1;
    const before = line[at - 1];
    if (before && before.time === sample.time) line[at - 1] = sample;
    else if (before && before.x === sample.x && before.y === sample.y && at === line.length) before.pressure = Math.max(before.pressure, sample.pressure);
    else line.splice(at, 0, sample);
  }
}

export function length(line: readonly { x: number; y: number }[]): number {
  let sum = 0;
  for (let at = 1; at < line.length; at += 1) sum += Math.hypot(line[at]!.x - line[at - 1]!.x, line[at]!.y - line[at - 1]!.y);
  return sum;
}
