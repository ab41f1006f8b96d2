// What shape does the ink have? The outline of a line whose width differs from point to point: down one side, round its end, up the other.

const CAP = 5; // points of a round end

/** x, y, x, y … of the outline; to be filled by the nonzero rule. `width`: full width at each point. */
export function outline(xy: readonly number[], width: readonly number[]): number[] {
  const count = xy.length / 2;
  const left: number[] = [];
  const right: number[] = [];
  let [dx, dy] = [1, 0];
  for (let at = 0; at < count; at += 1) {
    const [before, after] = [Math.max(0, at - 1), Math.min(count - 1, at + 1)];
    const [tx, ty] = [xy[2 * after]! - xy[2 * before]!, xy[2 * after + 1]! - xy[2 * before + 1]!];
    const long = Math.hypot(tx, ty);
    if (long > 0) [dx, dy] = [tx / long, ty / long];
    const half = width[at]! / 2;
    left.push(xy[2 * at]! + dy * half, xy[2 * at + 1]! - dx * half);
    right.push(xy[2 * at]! - dy * half, xy[2 * at + 1]! + dx * half);
    if (at === 0) left.unshift(...cap(xy[0]!, xy[1]!, half, Math.atan2(-dy, -dx)).flat());
    if (at === count - 1) left.push(...cap(xy[2 * at]!, xy[2 * at + 1]!, half, Math.atan2(dy, dx)).flat());
  }
  for (let at = count - 1; at >= 0; at -= 1) left.push(right[2 * at]!, right[2 * at + 1]!);
  return left;
}

/** Half a circle around a direction, clockwise on screen. */
function cap(x: number, y: number, radius: number, towards: number): [number, number][] {
  const points: [number, number][] = [];
  for (let step = 1; step < CAP; step += 1) {
    const angle = towards - Math.PI / 2 + (Math.PI * step) / CAP;
    points.push([x + radius * Math.cos(angle), y + radius * Math.sin(angle)]);
  }
  return points;
}

/** Width at each point of a stroke's ink: the pen's by its pressure; without pressure thinner towards the tip, as a branch is. */
export function widths(count: number, width: number, pressure: readonly number[] | null, tapers: boolean): number[] {
  const all: number[] = [];
  for (let at = 0; at < count; at += 1) {
    const along = count > 1 ? at / (count - 1) : 0;
    const press = pressure ? 0.3 + 0.9 * (pressure[at] ?? 0.5) : 1;
    const taper = tapers ? (pressure ? 1 - 0.25 * along ** 3 : 1 - 0.6 * along) : 1;
    all.push(width * press * taper);
  }
  return all;
}
