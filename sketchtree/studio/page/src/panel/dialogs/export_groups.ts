// Which format is for whom? The program tells which there are; they are put in groups, and what nobody foresaw comes last.

import type { Choice } from "../../messages";

export interface FormatGroup {
  title: string;
  formats: { format: Choice; hint: string }[];
}

const GROUPS: [string, [string, string][]][] = [
  ["Scenes", [
    [".glb", "Blender, Unity, Godot, web"], [".gltf", "to be edited"], [".usd", "Houdini, Maya, Unreal"], [".usda", "to be read"], [".usdc", "compact"],
    [".usdz", "iPhone, iPad"],
  ]],
  ["Meshes", [[".obj", "read by everything"], [".ply", "with colours"], [".stl", "no textures"], [".3mf", "wood only"]]],
  ["Branches as data", [[".swc", "a line a point"], [".mtg", "OpenAlea"], [".json", "columns"], [".h5", "for Python"]]],
  ["Studio", [[".sketchtree", "to go on with"]]],
  ["Pictures", [[".png", "rendered"]]],
];

/** Formats of the tree as it stands. */
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
