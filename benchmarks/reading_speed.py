"""How long does reading take? A grown drawing of 100, 1,000 and 10,000 strokes: the file, then the graph.

    python -m benchmarks.reading_speed [--strokes N ...]

Processor seconds of this process, after a first small drawing that loads the libraries.
"""

import argparse
import time

import numpy as np

from sketchtree.sketch.reading import sketch_graph
from sketchtree.sketch.files.svg import read_svg

HEIGHT = 1000.0
_CHILDREN = 6  # limbs that one limb carries


def drawing(strokes: int, seed: int = 0) -> bytes:
    """An SVG file of a tree of `strokes` curved limbs, every one drawn from its parent outward."""
    rng = np.random.default_rng(seed)
    lines = [_curve(np.array([0.0, 0.0]), np.pi / 2, 0.6 * HEIGHT, rng)]
    heading, length = [np.pi / 2], [0.6 * HEIGHT]
    for k in range(1, strokes):
        above = (k - 1) // _CHILDREN
        place = 0.25 + 0.75 * ((k - 1) % _CHILDREN + rng.uniform(0.2, 0.8)) / _CHILDREN
        foot = lines[above][int(place * (len(lines[above]) - 1))]
        heading.append(heading[above] + rng.choice([-1, 1]) * rng.uniform(0.4, 1.1))
        length.append(length[above] * rng.uniform(0.35, 0.6))
        lines.append(_curve(foot, heading[k], length[k], rng))
    paths = [f'<path d="M{" ".join(f"{x:.3f} {-y:.3f}" for x, y in line)}"/>' for line in lines]
    head = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="-1000 -1600 2000 1700"><g fill="none" stroke="#000">'
    return "\n".join([head, *paths, "</g></svg>"]).encode()


def _curve(foot, heading: float, length: float, rng):
    """A limb of twelve points that bends a little; the foot a pen's slip away from where it should be."""
    turn = heading + np.linspace(0.0, rng.normal(0.0, 0.3), 11)
    steps = np.stack([np.cos(turn), np.sin(turn)], 1) * length / 11
    return foot + rng.normal(0.0, 2e-4 * length, 2) + np.vstack([np.zeros(2), np.cumsum(steps, axis=0)])


def measure(strokes: int) -> tuple[float, float, int]:
    """(seconds for the file, seconds for the graph, segments) of a drawing of `strokes`."""
    data = drawing(strokes)
    times = [time.process_time()]
    sketch = read_svg(data, "drawing.svg")
    times.append(time.process_time())
    graph = sketch_graph(sketch)
    times.append(time.process_time())
    return times[1] - times[0], times[2] - times[1], graph.segment_count


def main() -> None:
    """Print one line a drawing."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--strokes", type=int, nargs="+", default=[100, 1_000, 10_000], help="how many strokes the drawings have")
    measure(50)
    print(f"{'strokes':>8} {'file s':>8} {'graph s':>8} {'both s':>8} {'segments':>9}")
    for strokes in parser.parse_args().strokes:
        file, graph, segments = measure(strokes)
        print(f"{strokes:>8,} {file:8.2f} {graph:8.2f} {file + graph:8.2f} {segments:>9,}")


if __name__ == "__main__":
    main()
