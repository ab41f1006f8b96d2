"""Does a tree grow to where the points are? Growth toward points (Guo et al. 2018) beside plain space colonisation, parts of ours left out, and the tree that is traced in the points.

    python -m benchmarks.cloud_growth [--shared DIR] [-o FOLDER] [--only CLOUD ...] [--ways WAY ...] [--seeds N] [--points N]

`--shared`: a folder with `data/pointclouds/*.ply`; without it clouds of our own: a little tree that was never scanned, and an exemplar as even points of its bark, as points that are off by
0.4 % of its height, and in leaf, seen unevenly. Of that the truth is known: how much of its length has the tree within 1 % of the height, and how much of the tree's has it, are told too.
A way's wood is made into tubes as the program makes them; from points to their surface the distance is exact, from the surface to points it is that of places spread evenly over its area.
`-o` draws front and side of each way.
"""

import argparse
import dataclasses
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree
from trimesh.triangles import closest_point

from benchmarks.cloud_sheets.grown_here import Here, here
from benchmarks.cloud_sheets.own_clouds import own_cloud
from sketchtree.clouds.files.read_cloud import read_cloud
from sketchtree.clouds.growing.estimated import KILL
from sketchtree.clouds.growing.wanted import Growing, plain
from sketchtree.clouds.tracing.traced import traced
from sketchtree.fidelity.recall import recall
from sketchtree.geometry.wood import wood_mesh
from sketchtree.keys import root_key
from sketchtree.skeleton import TreeSkeleton
from sketchtree.traverse import limb_chains

OURS = Growing(kill=KILL)
AS_PRINTED = dataclasses.replace(plain(5.0), influence=None, weighted=True)
OVER_GAPS = dataclasses.replace(AS_PRINTED, persists=True)
WAYS = {
    "traced": None,
    "grown": OURS,
    "grown, d_k 0.5 d_i": dataclasses.replace(OURS, kill=Growing().kill, holds=False),
    "grown, d_k 0.35 d_i": dataclasses.replace(OURS, holds=False),
    "grown, tropism up": dataclasses.replace(OURS, tropism=(0.0, 1.0, 0.0)),
    "grown, no weights": dataclasses.replace(OURS, weighted=False),
    "grown, always 5 l": dataclasses.replace(OURS, influence=5.0),
    "grown, always 10 l": dataclasses.replace(OURS, influence=10.0),
    "as printed": AS_PRINTED,
    "plain 5 l": plain(5.0),
    "plain 10 l": plain(10.0),
    "gaps: as printed": OVER_GAPS,
    "gaps: d_k held": dataclasses.replace(OVER_GAPS, holds=True),
    "gaps: no weights": dataclasses.replace(OVER_GAPS, weighted=False),
    "gaps: 5 l": dataclasses.replace(OVER_GAPS, influence=5.0),
    "gaps: 10 l": dataclasses.replace(OVER_GAPS, influence=10.0),
    "gaps: plain 5 l": dataclasses.replace(plain(5.0), persists=True),
    "gaps: plain 10 l": dataclasses.replace(plain(10.0), persists=True),
}
"""What is compared: all of ours; parts of it left out; the paper's method with nothing of ours; space colonisation without weights and logistic distance (the paper's Figures 5 and 6 take
those away). The paper's buds end where they see no point; over gaps they look on, as ours do, so that what is taken away is all that differs."""

EXEMPLAR = "norway_maple"
_PLACES = 200_000  # on a surface
_NEAREST = 6  # places whose triangles are looked at for a point
_PIECE = 0.04  # of the height, over which a limb's windings are told


def surface(tree: TreeSkeleton) -> tuple[np.ndarray, np.ndarray, np.ndarray, int]:
    """(triangles, places spread over them, the triangle of each, how many triangles) of a tree's wood as tubes."""
    mesh = wood_mesh(tree, bark="oak", key=root_key(0), wood="tubes")
    corner = np.asarray(mesh.position, float)[np.asarray(mesh.triangle)]
    area = np.linalg.norm(np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]), axis=1)
    rng = np.random.default_rng(0)
    of = rng.choice(len(area), _PLACES, p=area / area.sum())
    u, v = rng.uniform(size=(2, _PLACES, 1))
    u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
    a, b, c = corner[of].swapaxes(0, 1)
    return corner, a + u * (b - a) + v * (c - a), of, len(corner)


def distances(xyz: np.ndarray, tree: TreeSkeleton) -> tuple[np.ndarray, np.ndarray, int]:
    """(from every point to the surface, from the surface to points, triangles), metres."""
    corner, place, of, triangles = surface(tree)
    far, near = cKDTree(place).query(xyz, k=_NEAREST)
    for k in range(_NEAREST):
        exact = np.linalg.norm(closest_point(corner[of[near[:, k]]], xyz) - xyz, axis=1)
        far[:, 0] = np.minimum(far[:, 0], exact)
    return far[:, 0], cKDTree(xyz).query(place)[0], triangles


def windings(tree: TreeSkeleton, height: float) -> float:
    """How much longer limbs are than the steps of 4 % of the height along them."""
    whole = steps = 0.0
    for rows in limb_chains(tree.parent, tree.limb):
        line = tree.tip[rows if tree.parent[rows[0]] < 0 else np.r_[tree.parent[rows[0]], rows]]
        along = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))]
        if along[-1] < _PIECE * height:
            continue
        at = np.linspace(0.0, along[-1], int(along[-1] / (_PIECE * height)) + 1)
        whole += along[-1]
        steps += np.linalg.norm(np.diff(np.stack([np.interp(at, along, axis) for axis in line.T], axis=1), axis=0), axis=1).sum()
    return whole / max(steps, 1e-9)


def little_tree() -> np.ndarray:
    """Points on the bark of a trunk with twelve boughs, each with three branches, a tenth of which nobody saw."""
    rng, found = np.random.default_rng(0), []

    def bark(line, thick, thin):
        along = np.linspace(0, 1, max(8, int(np.linalg.norm(line[-1] - line[0]) / 0.01)))
        middle = np.stack([np.interp(along, np.linspace(0, 1, len(line)), axis) for axis in np.asarray(line).T], axis=1)
        out = rng.normal(size=(len(middle), 6, 3))
        found.append((middle[:, None] + (thick + (thin - thick) * along)[:, None, None] * out / np.linalg.norm(out, axis=2, keepdims=True)).reshape(-1, 3))

    def bough(start, turn, lean, length, thick, level):
        way = np.array([np.sin(lean) * np.cos(turn), np.cos(lean), np.sin(lean) * np.sin(turn)])
        end = start + length * way
        bark([start, start + 0.5 * length * way + [0, 0.04 * length, 0], end], thick, 0.3 * thick)
        for k in range(3 if level else 0):
            bough(start + (0.4 + 0.25 * k) * length * way, turn + 0.7 * (-1) ** k, lean + 0.3 * (-1) ** (k // 2), 0.4 * length, 0.4 * thick, level - 1)

    bark([np.zeros(3), [0.05, 3.0, 0.0], [0.0, 6.0, 0.1]], 0.12, 0.02)
    for k in range(12):
        bough(np.array([0.04, 1.8 + 0.33 * k, 0.0]), 2.4 * k, 1.0 - 0.03 * k, 2.2 - 0.12 * k, 0.045, 2)
    points = np.concatenate(found)
    return points[(rng.uniform(size=len(points)) > 0.1) & (np.sin(3 * points[:, 1]) < 0.95)]


OWN = {"bare": {}, "noisy": {"noise": 0.004}, "in leaf": {"leafy": 0.5, "noise": 0.003, "uneven": True}}
"""How an exemplar is seen."""


def clouds(shared: Path | None, only: list[str] | None, points: int) -> Iterator[tuple[str, np.ndarray, TreeSkeleton | None]]:
    """(name, points, the true tree where it is known) of every cloud."""
    if shared is not None:
        for path in sorted((shared / "data" / "pointclouds").glob("*.ply")):
            if not only or path.stem in only:
                yield path.stem, np.asarray(read_cloud(path).xyz), None
        return
    if not only or "little tree" in only:
        yield "little tree", little_tree(), None
    for how, seen in OWN.items():
        if not only or how in only:
            cloud = own_cloud(EXEMPLAR, points, **seen)
            yield f"{EXEMPLAR} {how}", cloud.xyz, cloud.tree


def made(stands: Here, way: Growing | None, seed: int) -> TreeSkeleton:
    """The tree of one way."""
    return traced(stands.xyz, stands.feet).skeleton if way is None else stands.grows(way, seed=seed).skeleton


def table(name: str, xyz: np.ndarray, known: TreeSkeleton | None, ways: list[str], seeds: int) -> dict[str, TreeSkeleton]:
    """One cloud's rows; the trees of the first seed."""
    height, stands, trees = float(np.ptp(xyz[:, 1])), here(xyz), {}
    kind = stands.kind
    print(f"\n{name}: {len(xyz):,} points, {height:.2f} m high, internode {kind.internode:.3f} m in the box, ψ {kind.branching:.0f}°, φ {kind.roll:.0f}°, γ {kind.gamma:.2f}, {len(stands.feet)} foot(s)")
    print(f"{'':24}points → surface, m        of H   within 1.5 %   surface → points, m   length, m  windings  triangles   CPU, s{'' if known is None else '   recall, precision'}")
    for way in ways:
        rows = []
        for seed in range(1 if WAYS[way] is None else seeds):
            began = time.process_time()
            tree = made(stands, WAYS[way], seed)
            seconds = time.process_time() - began
            trees.setdefault(way, tree)
            there, back, triangles = distances(xyz, tree)
            near = (there < 0.015 * height).mean()
            alike = (0.0, 0.0) if known is None else _alike(known, tree)
            rows.append((there.mean(), np.quantile(there, 0.95), there.mean() / height, near, back.mean(), tree.length.sum(), windings(tree, height), triangles, seconds, *alike))
        mean, most, share, within, back, length, winds, triangles, seconds, found, true = np.mean(rows, axis=0)
        there = f"mean {mean:.4f}  95 % {most:.3f}   {share:6.2%}   {within:6.1%}"
        print(f"  {way:22}{there}          {back:.4f}               {length:8.1f}   {winds:.3f}   {triangles:9,.0f}  {seconds:6.1f}{'' if known is None else f'   {found:6.1%}  {true:6.1%}'}", flush=True)
    return trees


def _alike(known: TreeSkeleton, tree: TreeSkeleton) -> tuple[float, float]:
    """Of the length."""
    found = recall(known, tree)
    return found.length_recall, found.length_precision


def draw(trees: dict[str, TreeSkeleton], xyz: np.ndarray, path: Path) -> None:
    """Front and side of each, the points beside them."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib.collections import LineCollection

    figure, axes = plt.subplots(2, len(trees) + 1, figsize=(5.0 * (len(trees) + 1), 13), squeeze=False)
    for row, across in enumerate((0, 2)):
        axes[row, 0].scatter(xyz[:, across], xyz[:, 1], s=0.4, c="k", lw=0)
        for place, (way, tree) in zip(axes[row, 1:], trees.items(), strict=True):
            lines = np.stack([tree.start[:, [across, 1]], tree.tip[:, [across, 1]]], axis=1)
            place.add_collection(LineCollection(lines, linewidths=np.clip(tree.radius / np.ptp(xyz[:, 1]) * 860, 0.25, None), colors="k", capstyle="round"))
            place.set_title(way)
    for place in axes.ravel():
        place.set(aspect="equal", xlim=None)
        place.axis("off")
        place.autoscale()
    figure.tight_layout()
    figure.savefig(path, dpi=70)
    plt.close(figure)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--shared", type=Path)
    parser.add_argument("-o", "--out", type=Path)
    parser.add_argument("--only", nargs="+")
    parser.add_argument("--ways", nargs="+", choices=list(WAYS), default=list(WAYS))
    parser.add_argument("--seeds", type=int, default=1)
    parser.add_argument("--points", type=int, default=20_000, help="of the exemplar's clouds")
    asked = parser.parse_args()
    for name, xyz, known in clouds(asked.shared, asked.only, asked.points):
        trees = table(name, xyz, known, asked.ways, asked.seeds)
        if asked.out:
            asked.out.mkdir(parents=True, exist_ok=True)
            draw(trees, xyz, asked.out / f"{name.replace(' ', '_')}.png")


if __name__ == "__main__":
    main()
