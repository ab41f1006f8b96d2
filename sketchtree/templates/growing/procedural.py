"""What tree does a recipe describe? The procedural generator of exemplars.

Limbs are grown level by level, each from its insertion to its tip (`shoot`). Nodes along it bear laterals, single or in whorls,
whose length and divergence depend on their place; at a fork the limb goes on as two or more of its own kind, so that trunks
dissolve into limbs (`offspring`). Who grows first takes the room (`space`), and the wind bends all alike (`wind`). All numbers
come from the recipe; the same recipe and seed give the same tree, and the random numbers of a limb are its own (`draws`).
"""

from collections import deque
from math import cos, pi, radians, sin, sqrt, tan

import numpy as np

from sketchtree.axes import NULL
from sketchtree.errors import TemplateError
from sketchtree.skeleton import TreeSkeleton
from sketchtree.templates.growing.draws import Draws, limb_stream_id
from sketchtree.templates.growing.headings import UP, along, unit
from sketchtree.templates.growing.offspring import offspring
from sketchtree.templates.growing.pipes import pipe_radii
from sketchtree.templates.growing.recipe import Recipe
from sketchtree.templates.growing.shoot import Shoot
from sketchtree.templates.growing.site import Bud, Site

MAX_SEGMENTS = 20_000  # a recipe that grows more is refused


def grow(recipe: Recipe, seed: int | None = None) -> TreeSkeleton:
    """The exemplar's skeleton: metres, y up, the (first) stem's base near the origin."""
    site = Site.of(recipe, recipe.seed if seed is None else seed)
    rows = site.rows
    buds = deque(_stem(site, stem) for stem in range(int(recipe.crown.stems)))
    limb = 0
    while buds:
        shoot = Shoot(site, buds.popleft(), limb)
        buds.extend(offspring(shoot, shoot.grow()))
        limb += 1
        if len(rows) > MAX_SEGMENTS:
            raise _too_many(recipe)
    tree = TreeSkeleton.from_columns(
        np.array(rows.parent), np.array(rows.tip), np.ones(len(rows)),
        order=np.array(rows.order), limb=_numbered(rows.limb),
    )  # fmt: skip
    return tree.replace(radius=pipe_radii(tree, recipe.habit, np.array(rows.lost)))


def _numbered(limb: list[int]) -> np.ndarray:
    """Limbs counted from 0 without gaps: some never grew, or were shed."""
    return np.unique(np.array(limb), return_inverse=True)[1]


def _too_many(recipe: Recipe) -> TemplateError:
    return TemplateError(
        f"Recipe {recipe.name}: it grows more than {MAX_SEGMENTS} segments.",
        remedy="Use longer segments, wider spacing, smaller ratios or fewer levels.",
    )


def _stem(site: Site, stem: int) -> Bud:
    crown, table = site.recipe.crown, site.recipe.level(0)
    draws = Draws(site.seed, limb_stream_id(0, stem))
    rank = stem / max(1.0, crown.stems - 1)
    azimuth = radians(137.5 * stem) + draws.normal(0.3) if crown.stems > 1 else draws.between(0, 2 * pi)
    out = (cos(azimuth), 0.0, sin(azimuth))
    base = site.rows.add(NULL, along((0.0, 0.0, 0.0), crown.stem_ring * sqrt(rank), out), 0, stem)
    heading = unit(along(UP, tan(radians(crown.stem_lean(rank))), out))
    length = table.ratio(rank) * crown.height * draws.log_normal(table.ratio_sd)
    return Bud(base, heading, 0, 0, length, limb_stream_id(0, stem), draws, borne=rank)
