// How is a tree drawn in two small views? From the front x goes right and y down; from above x goes right and the viewer's side is at the bottom.
// Both views have one scale, so that a flat tree looks flat.

export interface Lines {
  front: number[][]; // a limb each: x, y, x, y … in pixels
  above: number[][];
}

export interface Room {
  width: number;
  height: number;
  margin: number;
}

export function twoViews(paths: readonly (readonly number[])[], front: Room, above: Room): Lines {
  const box = bounds(paths);
  const wide = Math.max(box.right - box.left, 1e-9);
  const tall = Math.max(box.bottom - box.top, 1e-9);
  const deep = Math.max(box.near - box.far, 1e-9);
  const scale = Math.min(fit(wide, front.width, front), fit(tall, front.height, front), fit(wide, above.width, above), fit(deep, above.height, above));
  const middle = (box.left + box.right) / 2;
  const place = (room: Room, horizontal: number, from: number, at: number): [number, number] => [
    room.width / 2 + (horizontal - middle) * scale,
    room.height / 2 + (at - from) * scale,
  ];
  const lines = (room: Room, from: number, pick: 1 | 2): number[][] =>
    paths.map((path) => {
      const line: number[] = [];
      for (let i = 0; i + 2 < path.length; i += 3) line.push(...place(room, path[i]!, from, path[i + pick]!));
      return line;
    });
  return { front: lines(front, (box.top + box.bottom) / 2, 1), above: lines(above, (box.far + box.near) / 2, 2) };
}

interface Bounds {
  left: number;
  right: number;
  top: number;
  bottom: number;
  far: number;
  near: number;
}

function bounds(paths: readonly (readonly number[])[]): Bounds {
  const box: Bounds = { left: Infinity, right: -Infinity, top: Infinity, bottom: -Infinity, far: Infinity, near: -Infinity };
  for (const path of paths)
    for (let i = 0; i + 2 < path.length; i += 3) {
      box.left = Math.min(box.left, path[i]!);
      box.right = Math.max(box.right, path[i]!);
      box.top = Math.min(box.top, path[i + 1]!);
      box.bottom = Math.max(box.bottom, path[i + 1]!);
      box.far = Math.min(box.far, path[i + 2]!);
      box.near = Math.max(box.near, path[i + 2]!);
    }
  return box;
}

function fit(extent: number, side: number, room: Room): number {
  return Math.max(side - 2 * room.margin, 1) / extent;
}
