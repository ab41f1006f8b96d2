// Which limbs of a reading are elsewhere than in the tree one sees? On the page all readings are alike, so it is their depths that are compared.

const MUCH = 0.05; // of the drawing's extent

/** One answer a limb; none differs where the limbs are not the same ones. */
export function differing(paths: readonly (readonly number[])[], seen: readonly (readonly number[])[]): boolean[] {
  const much = MUCH * extent(seen);
  const same = paths.length === seen.length;
  return paths.map((path, limb) => same && path.length === seen[limb]!.length && farthest(path, seen[limb]!) > much);
}

function farthest(path: readonly number[], other: readonly number[]): number {
  let most = 0;
  for (let i = 2; i < path.length; i += 3) most = Math.max(most, Math.abs(path[i]! - other[i]!));
  return most;
}

function extent(paths: readonly (readonly number[])[]): number {
  const low = [Infinity, Infinity];
  const high = [-Infinity, -Infinity];
  for (const path of paths)
    path.forEach((value, index) => {
      const axis = index % 3;
      if (axis === 2) return;
      low[axis] = Math.min(low[axis]!, value);
      high[axis] = Math.max(high[axis]!, value);
    });
  return Math.max(high[0]! - low[0]!, high[1]! - low[1]!, 0);
}
