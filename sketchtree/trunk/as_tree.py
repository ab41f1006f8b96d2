"""From the picture into space: the trunk as a `TreeSkeleton` whose projection is what was seen.

Two ways to find depths: `siblings` (§II.3, rotations about the parent's axis), and `elevation`, ours: the same inference that strokes go through, with a template, if there are any. Either way x and y of every point are the
picture's under one similarity, to the last bit, and so is thickness.
"""

import dataclasses

from jaxtyping import Array, Key

from sketchtree.drawn_tree import draw_out_graph
from sketchtree.errors import OptionError
from sketchtree.keys import stage_key
from sketchtree.mrf.lift import lift as in_space
from sketchtree.options import ReadingOptions
from sketchtree.page import page_to_world
from sketchtree.parameters import Habit
from sketchtree.skeleton import TreeSkeleton
from sketchtree.templates.store.database import Database
from sketchtree.trunk.limbs import trunk_drawing
from sketchtree.trunk.siblings import SPREAD, sibling_angles, sibling_depth
from sketchtree.trunk.trunk_skeleton import TrunkSkeleton
from sketchtree.trunk.wanted import LIFTS


def as_tree(
    skeleton: TrunkSkeleton,
    *,
    key: Key[Array, ""],
    lift: str = "siblings",
    height: float | None = None,
    spread: float = SPREAD,
    options: ReadingOptions = ReadingOptions(),
    templates: Database | None = None,
) -> TreeSkeleton:
    """The trunk in metres, root at the origin. `height`: of its highest point (None: the habit's); `spread`: σ of the siblings' angles, radians; `options`, `templates`: of `elevation`."""
    if lift not in LIFTS:
        raise OptionError(f"There is no lift called `{lift}`.", remedy=f"Use one of: {', '.join(LIFTS)}.")
    if height is not None and not 0.0 < height < float("inf"):
        raise OptionError(f"A height of {height:g} m is not positive.", remedy="Give metres above 0.")
    if len(skeleton) < 2:
        raise OptionError("The trunk's skeleton is a single point.", remedy="Ask for more vertices, or give a larger picture.")
    sketch, graph = trunk_drawing(skeleton)
    if lift == "elevation":
        asked = options if height is None else dataclasses.replace(options, height=height)
        drawn = draw_out_graph(sketch, graph, templates, key=stage_key(key, "elevation"), options=asked)
        same = len(drawn.skeleton) == len(graph)  # a template may give it roots, which nobody measured
        return drawn.skeleton.replace(radius=graph.width / 2.0 * drawn.similarity.scale) if same else drawn.skeleton
    depth = sibling_depth(graph, sibling_angles(graph, stage_key(key, "siblings"), spread))
    similarity = page_to_world(graph, height or Habit().height)
    return in_space(graph, depth, similarity, radius=graph.width / 2.0 * similarity.scale)
