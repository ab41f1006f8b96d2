"""How deep is every pixel of every photo? Views → depth maps: PatchMatch from coarse to fine, segments, coherence, refinement, the guided filter (Guo et al. 2018, §4).

Each of the three things that the paper adds to plain PatchMatch can be left out, to see what it is worth.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from jaxtyping import Key

from sketchtree.errors import ViewsError
from sketchtree.keys import numpy_generator, stage_key
from sketchtree.multiview.accelerated.engine import engine_of
from sketchtree.multiview.compiled import side_by_side
from sketchtree.multiview.guided import smoothed
from sketchtree.multiview.patchmatch import finer, starting, sweep
from sketchtree.multiview.photos import View
from sketchtree.multiview.refine import disparity_unit, refined, scored
from sketchtree.multiview.segments import planes_of, segments_of
from sketchtree.multiview.sources import Sources
from sketchtree.multiview.workplace import Level, Partners, level_of, partners
from sketchtree.watch import Pulse, Watch, no_pulse, shared


@dataclass(frozen=True)
class Quality:
    """How much work a depth map is worth."""

    longest: int  # pixels a side of the photos
    sources: int  # partners of a view
    shrinks: tuple[int, ...]  # levels, coarsest first
    rounds: tuple[int, ...]  # sweeps of both colours at each
    best: int = 2  # partners that count at a pixel
    step: int = 1  # pixels between the 5 × 5 samples of a patch: twigs are thin
    segments: bool = True  # Eq. 2's second term
    coherence: bool = True  # Eq. 3-4 by fusion moves
    guided: int = 2  # radius of the guided filter, pixels; 0: none
    engine: str = "auto"  # what works PatchMatch out: numba | jax; auto: jax where it has a GPU


PREVIEW = Quality(longest=480, sources=4, shrinks=(2, 1), rounds=(4, 2))
FULL = Quality(longest=1000, sources=5, shrinks=(4, 2, 1), rounds=(5, 3, 2))


def depth_maps(
    views: list[View], sources: list[Sources], quality: Quality, *, key: Key, watch: Watch | None = None, pulse: Pulse = no_pulse
) -> list[Level]:
    """A depth map for every view; one without partners has none. Raises ViewsError where no view has a partner."""
    if not any(len(one.rows) for one in sources):
        raise ViewsError("No two photos look at the same place from near enough.", remedy="Take photos every 10-15° round the plant, and check the poses.")
    quality = replace(quality, engine=engine_of(quality.engine))
    watch = watch or Watch()
    tell = watch.on_part
    levels: list[Level] = []
    with watch("patchmatch"):
        for n, (shrink, rounds) in enumerate(zip(quality.shrinks, quality.rounds, strict=True)):
            coarser, levels = levels, [level_of(view, one, shrink) for view, one in zip(views, sources, strict=True)]
            _begin(levels, coarser, key)
            part = shared(tell, n / len(quality.shrinks), (n + 1) / len(quality.shrinks))
            _swept(levels, quality, rounds, n, stage_key(key, f"level {n}"), pulse, part)
    if quality.coherence:
        with watch("coherence"):
            _refine(levels, quality, pulse, tell)
    with watch("filter"):
        _finish(levels, quality, pulse, tell)
    return levels


def _begin(levels: list[Level], coarser: list[Level], key) -> None:
    for k, level in enumerate(levels):
        if coarser:
            level.plane[:] = finer(coarser[k].plane, level.shape)
        else:
            level.plane[:] = starting(level.shape, level.sources.low, level.sources.high, numpy_generator(stage_key(key, level.name)))
        if not len(level.sources.rows):
            level.used[:] = False


def _swept(levels: list[Level], quality: Quality, rounds: int, number: int, key, pulse: Pulse, part: Callable[[float], None]) -> None:
    """PatchMatch on one level of all views."""
    seeds = numpy_generator(key).integers(0, 2**63, (len(levels), rounds, 2), dtype=np.uint64)

    def one(row: int) -> None:
        level = levels[row]
        if not level.used.any():
            return
        sweep_once = _sweeps(level, partners(level, levels), quality)
        if quality.segments:
            level.segment = segments_of(level.rgb, level.used)
        prior = np.zeros_like(level.plane)
        for turn in range(rounds):
            if quality.segments and (turn or number):
                prior = planes_of(level.segment, level.plane, level.energy if turn else np.zeros_like(level.energy), level.sources.low, level.sources.high)
            for colour in (0, 1):
                sweep_once(colour, prior, 0.05 * 0.5 ** (turn + 2 * number), 2 if number == 0 else 1, seeds[row, turn, colour])

    side_by_side(one, range(len(levels)), pulse, part)


def _sweeps(level: Level, near: Partners, quality: Quality) -> Callable:
    """A function that sweeps one colour of a level once, by the engine wanted."""
    if quality.engine == "jax":
        from sketchtree.multiview.accelerated.sweep_jax import Sweeps

        return Sweeps(level, near, quality.step, quality.best)
    return partial(_sweep, level, near, quality)


def _sweep(level: Level, near: Partners, quality: Quality, colour: int, prior, spread: float, fresh: int, seed) -> None:
    sweep(
        colour, 0, level.shape[0], level.grey, level.used, level.plane, level.energy, prior, level.sources.low, level.sources.high, float(level.camera.matrix[0, 0]),
        near.transfers, near.others, near.sizes, quality.step, quality.best, spread, fresh, np.uint64(seed),
    )


def _refine(levels: list[Level], quality: Quality, pulse: Pulse, part) -> None:
    def one(row: int) -> np.ndarray:
        level = levels[row]
        if not level.used.any():
            return level.plane
        label = segments_of(level.rgb, level.used) if level.segment is None else level.segment
        return refined(level, levels, partners(level, levels), label, quality.step)[0]

    planes = side_by_side(one, range(len(levels)), pulse, part)
    for level, plane in zip(levels, planes, strict=True):
        level.plane = plane


def _finish(levels: list[Level], quality: Quality, pulse: Pulse, part) -> None:
    """The guided filter, and the last likelihoods. A pixel that the filter would make less likely keeps its depth."""

    def score(row: int) -> None:
        level = levels[row]
        level.likely, level.agreeing = np.zeros(level.shape, np.float32), np.zeros(level.shape, np.int64)
        if level.used.any():
            level.likely, level.agreeing = scored(level, levels, partners(level, levels), level.plane, quality.step)

    def smooth(row: int) -> np.ndarray:
        level = levels[row]
        if not level.used.any():
            return level.plane[..., 0]
        return smoothed(level.plane, level.grey, level.likely, disparity_unit(level, levels), quality.guided)

    side_by_side(score, range(len(levels)), pulse, shared(part, 0.0, 0.5))
    if not quality.guided:
        return
    before = [(level.plane.copy(), level.likely, level.agreeing) for level in levels]
    for level, rho in zip(levels, side_by_side(smooth, range(len(levels)), pulse, shared(part, 0.5, 0.6)), strict=True):
        level.plane[..., 0] = np.where(level.used & (level.likely > 0), rho, level.plane[..., 0])
    side_by_side(score, range(len(levels)), pulse, shared(part, 0.6, 1.0))
    for level, (plane, likely, agreeing) in zip(levels, before, strict=True):
        worse = level.likely < likely
        level.plane[worse], level.likely[worse], level.agreeing[worse] = plane[worse], likely[worse], agreeing[worse]
