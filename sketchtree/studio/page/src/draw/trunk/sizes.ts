// How wide is what is in hand? The pen, the brush that scribbles and the one that paints each keep a width of their own.

import type { Tool, Ui } from "../../store";

type Sized = keyof Pick<Ui, "width" | "brush" | "paint">;

export function brushOf(tool: Tool): Sized {
  if (tool === "foreground" || tool === "background") return "brush";
  return tool === "matte_add" || tool === "matte_erase" ? "paint" : "width";
}
