// Which format is for whom? The program tells which there are; they are put in groups, and what nobody foresaw comes last.

import type { Choice } from "../../messages";

export interface FormatGroup {
  title: string;
  formats: { format: Choice; hint: string }[];
}

const GROUPS: [string, [string, string][]][] = [
  ["Scenes: Blender, Unreal, Unity, Godot, three.js", [
    [".glb", "One file with everything in it"], [".gltf", "JSON with textures beside it"], [".usd", "Houdini, Maya, Omniverse"], [".usda", "USD as text"], [".usdc", "USD, compact"],
    [".usdz", "iPhone and iPad"],
  ]],
  ["Meshes", [[".obj", "Read by everything"], [".ply", "With colours"], [".stl", "3D printing"], [".3mf", "3D printing, wood only"]]],
  ["Branches as data", [[".swc", "A line a segment"], [".mtg", "OpenAlea"], [".json", "Columns"], [".h5", "Columns, for Python"]]],
  ["Pictures", [[".png", "A rendered picture"]]],
];

export function groups(formats: readonly Choice[]): FormatGroup[] {
  const left = new Map(formats.map((format) => [format.name, format]));
  const made = GROUPS.map(([title, names]) => ({
    title,
    formats: names.flatMap(([name, hint]) => {
      const format = left.get(name);
      left.delete(name);
      return format ? [{ format, hint }] : [];
    }),
  }));
  made.push({ title: "Others", formats: [...left.values()].map((format) => ({ format, hint: "" })) });
  return made.filter((group) => group.formats.length > 0);
}
