"""How long does propagation take, and does it stay linear?

    python -m benchmarks.propagate [--repeat N] [--plot PICTURE.png]

A drawn tree of a trunk and 14 limbs is propagated to 4,291 segments (the tree for which Chen et al. 2008
report 50 s), to 100,000 and to 1,000,000, without and with a crown. Warm: the best of `repeat` runs after one. With `--plot` also sizes
in between, and the line that is as steep as strictly linear time.
"""

import argparse
import dataclasses
import resource
import sys
import time
from pathlib import Path

import numpy as np

from sketchtree import keys, limb_ids
from sketchtree.axes import NULL
from sketchtree.parameters import GENERIC, Habit
from sketchtree.propagate.generations import propagate
from sketchtree.skeleton import Kind, TreeSkeleton

SEGMENTS = (4_291, 100_000, 1_000_000)
BETWEEN = (1_500, 4_291, 12_000, 35_000, 100_000, 300_000, 1_000_000)  # of the plot
BARS = {4_291: 0.05, 100_000: 0.5, 1_000_000: 5.0}  # seconds
LIMBS = 14
HEIGHT = 12.0  # metres


def drawn_tree() -> TreeSkeleton:
    """A trunk and limbs at golden-angle azimuths, as a sketch of 15 strokes gives them."""
    height = np.linspace(0.35, 0.95, LIMBS) * HEIGHT
    parent = [NULL, *range(LIMBS + 1)]
    tip = [[0, 0, 0]] + [[0.02 * i, y, 0.0] for i, y in enumerate(height)] + [[0.2, HEIGHT, 0.1]]
    order, limb = [0] * (LIMBS + 2), [limb_ids.stroke_limb_id("trunk")] * (LIMBS + 2)
    for i in range(LIMBS):
        out = np.array([np.cos(2.4 * i), 0.7, np.sin(2.4 * i)]) * (4.0 - 2.0 * i / LIMBS) / 3
        for step in range(3):
            above = i + 1 if step == 0 else len(parent) - 1
            tip.append(list(np.array(tip[above]) + out + [0, 0.1 * step, 0]))
            parent.append(above)
            order.append(1)
            limb.append(limb_ids.stroke_limb_id(f"limb {i}"))
    rows = len(parent)
    return TreeSkeleton.from_columns(
        np.array(parent), np.array(tip), np.linspace(0.25, 0.02, rows), order=np.array(order), limb=np.array(limb),
        stroke=np.zeros(rows, int), kind=np.full(rows, int(Kind.DRAWN)),
    )  # fmt: skip


def habit_for(segments: int) -> Habit:
    """A habit that grows at least as many segments: finer twigs, closer together."""
    fine = 1.0 if segments < 50_000 else 0.45 if segments < 500_000 else 0.3
    return dataclasses.replace(
        Habit(height=HEIGHT), max_order=8, lateral_spacing=0.4 * fine, twig_length=0.2 * fine**1.5, lateral_ratio=0.55
    )


def crown() -> np.ndarray:
    """A round outline about the limbs."""
    turn = np.linspace(0, 2 * np.pi, 90, endpoint=False)
    return np.column_stack([6.0 * np.cos(turn), 8.0 + 5.5 * np.sin(turn)])


def seconds(segments: int, outlines: tuple, repeat: int) -> tuple[int, float, float]:
    """(segments made, cold seconds, best warm seconds)."""
    tree, habit, key = drawn_tree(), habit_for(segments), keys.root_key(0)
    laps = []
    for _ in range(repeat + 1):
        began = time.perf_counter()
        result = propagate(tree, habit, GENERIC, crown=outlines, generations=12, max_segments=segments, key=key)
        laps.append(time.perf_counter() - began)
    return result.skeleton.segment_count, laps[0], min(laps[1:])


def plot(rows: list[tuple[str, int, float]], path: Path) -> None:
    """Seconds over segments, both logarithmic, without and with a crown, and the bars."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(figsize=(6, 4.2), layout="constrained")
    for name in dict.fromkeys(name for name, _, _ in rows):
        made, laps = np.array([(made, lap) for which, made, lap in rows if which == name]).T
        axes.loglog(made, laps, "o-", label=name)
    made, laps = np.array([(made, lap) for which, made, lap in rows if which == rows[0][0]]).T
    axes.loglog(made, laps[-1] * made / made[-1], ":", color="grey", label="linear")
    axes.loglog(list(BARS), list(BARS.values()), "x", color="black", label="bars")
    axes.set(xlabel="segments", ylabel="seconds, warm")
    axes.legend()
    figure.savefig(path, dpi=110)


def main(argv=None) -> None:
    """Prints one line a size."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--repeat", type=int, default=3, help="warm runs (default 3)")
    parser.add_argument("--plot", type=Path, help="draw seconds over segments")
    options = parser.parse_args(argv)
    rows = []
    print(f"{'asked':>10} {'crown':>6} {'segments':>10} {'cold s':>8} {'warm s':>8} {'µs a segment':>13}")
    for name, outlines in (("no crown", ()), ("crown", (crown(),))):
        for segments in BETWEEN if options.plot else SEGMENTS:
            made, cold, warm = seconds(segments, outlines, max(1, options.repeat))
            rows.append((name, made, warm))
            print(f"{segments:>10,} {'yes' if outlines else 'no':>6} {made:>10,} {cold:>8.3f} {warm:>8.3f} {1e6 * warm / made:>13.2f}")
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / (1024 if sys.platform != "darwin" else 1024**2)
    print(f"peak memory {peak:,.0f} MB")
    if options.plot:
        plot(rows, options.plot)


if __name__ == "__main__":
    main()
