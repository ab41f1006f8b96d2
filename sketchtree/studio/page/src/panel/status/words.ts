// What does the status line say? Everything here is words: no element is touched.

import type { Tree, Warming, Working } from "../../messages";
import { count, counted, duration, metres } from "../figures";

export interface Said {
  name: string;
  value: string;
  title: string;
}

const STAGES: Record<string, string> = {
  read: "Reading the drawing", match: "Comparing with templates", infer: "Finding the depths", propagate: "Growing branches", foliage: "Putting on leaves",
  mesh: "Making the wood", export: "Writing the file",
};

const WARMS = "Getting ready for strokes over points";
const WAITS = "Getting ready to find depths, only this once";

/** What the program is at, for people; "": at nothing. */
export function doing(working: Pick<Working, "state" | "stage"> | null, warming: Pick<Warming, "on"> | null): string {
  const warms = warming?.on ?? false;
  if (working?.state !== "working") return warms ? WARMS : "";
  return warms && working.stage === "infer" ? WAITS : (STAGES[working.stage] ?? "Working");
}

/** The figures of a tree, most telling first. */
export function figures(tree: Tree, template: string | null, roundTrip: number | null): Said[] {
  const grown = tree.segments - tree.drawn;
  const triangles = tree.triangles.reduce((sum, one) => sum + one, 0);
  const [wood = 0, leaf = 0] = tree.triangles;
  const said: Said[] = [
    { name: "height", value: `${metres(tree.height)} tall`, title: "Height of the tree. The figure beside it is 1.8 m." },
    {
      name: "segments", value: counted(tree.segments, "segment", "segments"),
      title: `Pieces of branch: ${count(tree.drawn)} drawn, ${count(grown)} grown.`,
    },
    { name: "leaves", value: counted(tree.leaves, "leaf", "leaves"), title: "Leaves, needles or fronds." },
    { name: "triangles", value: counted(triangles, "triangle", "triangles"), title: `Triangles as shown: ${count(wood)} of wood, ${count(leaf)} of leaves.` },
  ];
  if (template !== null) said.push({ name: "template", value: template, title: "The template whose habit and leaves the tree has." });
  if (roundTrip !== null) said.push({ name: "round-trip", value: duration(roundTrip), title: "From your last change to the new tree on screen." });
  return said;
}
