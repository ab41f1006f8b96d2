// What of the tree goes into the file, and what goes together with what? The rules are the command line's (`FileOptions`); here they are known before
// anything fails.

export interface ExportOptions {
  lod: 0 | 1 | 2 | 3;
  levels: "one" | "together" | "apart";
  leaves: "merged" | "instanced";
  pack: "game" | null;
  wood: "one-piece" | "tubes" | null; // null: as the tree is
  solid: boolean;
}

export type OptionName = keyof ExportOptions;

export const USUAL: ExportOptions = { lod: 0, levels: "one", leaves: "merged", pack: null, wood: null, solid: false };

const SCENES = [".glb", ".gltf", ".usd", ".usda", ".usdc", ".usdz"];
const MESHES = [...SCENES, ".obj", ".ply", ".stl", ".3mf"];

export function isScene(format: string): boolean {
  return SCENES.includes(format);
}

export function isMesh(format: string): boolean {
  return MESHES.includes(format);
}

/** Why an option cannot be changed beside the others, for people; those that can are absent. */
export function blocked(options: ExportOptions): Partial<Record<OptionName, string>> {
  const why: Partial<Record<OptionName, string>> = {};
  if (options.pack) {
    why.lod = why.levels = "A game pack has all levels of detail";
    why.leaves = "Its leaves are one mesh";
  } else {
    if (options.levels !== "one") why.lod = "All levels of detail are written";
    if (options.lod > 0) why.leaves = "Leaves of less than full detail are one mesh";
  }
  return why;
}

/** What holds once an option was changed: those that no longer go with it are as usual. */
export function changed(options: ExportOptions, change: Partial<ExportOptions>): ExportOptions {
  const next = { ...options, ...change };
  for (const name of Object.keys(blocked(next)) as OptionName[]) Object.assign(next, { [name]: USUAL[name] });
  return next;
}

/** What a file of this format can take of them; the rest as usual. */
export function fitting(options: ExportOptions, format: string): ExportOptions {
  if (!isMesh(format)) return { ...USUAL };
  const pack = isScene(format) ? options.pack : null;
  const leaves = isScene(format) ? options.leaves : "merged";
  const levels = options.levels === "together" && !isScene(format) ? "one" : options.levels;
  return { ...options, pack, leaves, levels };
}
