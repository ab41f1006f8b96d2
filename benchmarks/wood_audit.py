"""Is the wood one closed surface? `python -m benchmarks.wood_audit [--trees NAME ...] [--ways one-piece tubes]`

One line a tree and way: triangles, parts and bases, open, non-manifold and turned edges, share of thin triangles, worst distance
of a vertex from the tube of its limb over the radius, share of vertices where it is beyond 5 %, and share of the area where the bark is stretched more than twice (both away from forks), tiles a
metre from the 5th to the 95th centile of the area, limbs that could not be joined, and seconds.

Edges are counted after welding at 1e-6 of the extent, as programs do. A triangle is thin when its longest edge is more than 50 times
its least altitude. Trees: every drawing in examples/, the six templates of `six_templates` on one sketch, a shrub of five stems, and a tree
that branches until it has 2,000 limbs.

Others' files by the same audit (parts, open edges, non-manifold edges, measured beside ours): Sapling 153, 688, 0; ez-tree 384, 2,468, 0;
Arbaro 1,222, 3,783, 0; AdTree 2,508, 50,160, 0; MTree's manifold mesher 1, 6,734, 35; proctree 1, 6, 0.
"""

import argparse
import sys
import time
from collections.abc import Iterator, Sequence
from pathlib import Path

import jax
import numpy as np
from jaxtyping import Float, Int
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from benchmarks.mesh import branching_tree
from benchmarks.six_templates import SIX, SKETCH
from sketchtree.geometry.collars import ways_out
from sketchtree.geometry.limbs import CentreLines, centre_lines
from sketchtree.geometry.mesh import Mesh
from sketchtree.geometry.radii import PipeRadii, is_frond
from sketchtree.geometry.wood import wood_of
from sketchtree.keys import root_key
from sketchtree.options import ReadingOptions, TreeOptions
from sketchtree.parameters import Habit
from sketchtree.pipeline import sketch_to_tree
from sketchtree.skeleton import TreeSkeleton

EXAMPLES = Path(__file__).parents[1] / "examples"
THIN, WELD = 50.0, 1e-6


def together(meshes: Sequence[Mesh]) -> tuple[Float[np.ndarray, "vertex 3"], Int[np.ndarray, "triangle 3"]]:
    """All vertices and triangles of some meshes."""
    first = np.cumsum([0] + [len(mesh.position) for mesh in meshes])
    return np.concatenate([mesh.position for mesh in meshes]), np.concatenate([mesh.triangle + k for mesh, k in zip(meshes, first, strict=False)])


def audit(position: Float[np.ndarray, "vertex 3"], triangle: Int[np.ndarray, "triangle 3"]) -> dict[str, float]:
    """Parts, edges by kind, share of thin triangles, volume (cubic metres) of the surface welded at 1e-6 of its extent."""
    extent = np.ptp(position, axis=0).max()
    _, same = np.unique(np.round((position - position.min(axis=0)) / extent / WELD).astype(np.int64), axis=0, return_inverse=True)
    corner = same.reshape(-1)[triangle]
    flat = (corner == np.roll(corner, 1, axis=1)).any(axis=1)
    edge = np.concatenate([corner[~flat][:, [a, b]] for a, b in ((0, 1), (1, 2), (2, 0))])
    size = int(corner.max()) + 1
    _, times = np.unique(np.sort(edge, axis=1) @ [size, 1], return_counts=True)
    _, ways = np.unique(edge @ [size, 1], return_counts=True)
    _, label = connected_components(coo_matrix((np.ones(len(edge)), edge.T), shape=(size, size)), directed=False)
    x = position[triangle]
    side = np.roll(x, -1, axis=1) - x
    double = np.linalg.norm(np.cross(side[:, 0], side[:, 1]), axis=1)
    return {
        "triangles": len(triangle),
        "parts": len(np.unique(label[corner[~flat]])),
        "open": int((times == 1).sum()),
        "nonmanifold": int((times > 2).sum()),
        "turned": int((ways > 1).sum()),
        "thin": float((double * THIN < (side**2).sum(axis=-1).max(axis=1)).mean()),
        "volume": float(np.sum(x[:, 0] * np.cross(x[:, 1], x[:, 2])) / 6.0),
    }


def off_forks(lines: CentreLines, meshes: Sequence[Mesh]) -> dict[str, float]:
    """Away from forks, the ground and tips: worst distance of a vertex from its limb's tube over the radius, share of the area
    whose texture is stretched more than twice, and tiles a metre at the 5th and 95th centile of the area."""
    position, triangle = together(meshes)
    uv = np.concatenate([mesh.uv for mesh in meshes])
    worst = _off_tubes(lines, position)
    away = ~_by_forks(lines, position)
    x, t = position[triangle], uv[triangle]
    kept = away[triangle].all(axis=1)
    edge, over = x[kept][:, 1:] - x[kept][:, :1], t[kept][:, 1:] - t[kept][:, :1]
    able = np.abs(np.linalg.det(over)) > 1e-14
    scale = np.linalg.svd(np.swapaxes(edge[able], 1, 2) @ np.linalg.inv(np.swapaxes(over[able], 1, 2)), compute_uv=False)
    area = np.linalg.norm(np.cross(edge[able][:, 0], edge[able][:, 1]), axis=1)
    density = 1.0 / np.sqrt(scale[:, 0] * scale[:, 1])
    order = np.argsort(density)
    share = np.cumsum(area[order]) / max(area.sum(), 1e-300)
    low, high = (float(density[order][min(np.searchsorted(share, q), len(order) - 1)]) for q in (0.05, 0.95))
    stretched = float(area[scale[:, 0] > 2.0 * scale[:, 1]].sum() / area.sum())
    return {"off": float(worst[away].max(initial=0.0)), "beyond": float((worst[away] > 0.05).mean()), "stretched": stretched, "tiles low": low, "tiles high": high}


def _off_tubes(lines: CentreLines, position):
    """How far each vertex is from the tube that it fits best, over the tube's radius; tubes are searched octave by octave of radius."""
    fine, radius = _fine(lines)
    octave = np.floor(np.log2(radius)).astype(int)
    worst = np.full(len(position), np.inf)
    for one in np.unique(octave):
        some = octave == one
        distance, near = cKDTree(fine[some]).query(position, k=min(8, int(some.sum())))
        near = radius[some][near.reshape(len(position), -1)]
        worst = np.minimum(worst, np.min(np.abs(distance.reshape(near.shape) - near) / near, axis=1))
    return worst


def _fine(lines: CentreLines):
    """Points along all lines, closer than a quarter of the radius, and the radius at each."""
    stretch = np.flatnonzero(np.diff(lines.of_point) == 0)
    parts = np.ceil(np.diff(lines.s)[stretch] / (0.1 * lines.radius[stretch])).astype(np.int64).clip(1, 400)
    at = np.repeat(stretch, parts)
    share = (np.arange(len(at)) - np.repeat(np.cumsum(parts) - parts, parts)) / np.repeat(parts, parts)
    point = lines.point[at] + share[:, None] * (lines.point[at + 1] - lines.point[at])
    return point, lines.radius[at] + share * (lines.radius[at + 1] - lines.radius[at])


def _by_forks(lines: CentreLines, position):
    """Which places are near a fork, the flare at the ground, or a tip."""
    fork = np.flatnonzero(lines.parent >= 0)
    foot = lines.radius[lines.start[:-1]]
    parts = [(lines.point[lines.start[1:] - 1], 1.6 * lines.radius[lines.start[1:] - 1])]
    if len(fork):
        way = ways_out(lines, fork)
        begin, thick = lines.at(lines.parent[fork], lines.parent_s[fork])
        end, _ = lines.at(fork, np.minimum(way.clear(1.8), lines.length[fork]))
        parts.append((begin, np.linalg.norm(end - begin, axis=1) + 2.5 * foot[fork] + 1.5 * thick))
    stem = np.flatnonzero(lines.is_stem)
    parts.append((lines.point[lines.start[:-1]][stem], 8.0 * foot[stem]))
    near = np.zeros(len(position), bool)
    tree = cKDTree(position)
    for centre, reach in parts:
        for found in tree.query_ball_point(centre, reach):
            near[found] = True
    return near


def shrub(stems: int = 5) -> TreeSkeleton:
    """Five stems on one base."""
    angle = 2.0 * np.pi * np.arange(stems) / stems
    tip = np.stack([0.5 * np.cos(angle), np.full(stems, 1.6), 0.5 * np.sin(angle)], axis=1)
    return TreeSkeleton.from_columns(
        np.r_[-1, np.zeros(stems, int)], np.vstack([np.zeros(3), tip]), np.r_[0.04, np.full(stems, 0.03)], limb=np.arange(stems + 1)
    )


def trees() -> Iterator[tuple[str, TreeSkeleton, Habit]]:
    """Name, skeleton and habit of every tree audited."""
    for path in sorted((*EXAMPLES.glob("*.svg"), *EXAMPLES.glob("*.json"))):
        made = sketch_to_tree(path, key=root_key(0), tree=TreeOptions(leaf="none"))
        yield path.name, made.skeleton, made.drawn.habit
    for template in SIX:
        made = sketch_to_tree(SKETCH, key=root_key(0), reading=ReadingOptions(template=template), tree=TreeOptions(leaf="none"))
        yield template, made.skeleton, made.drawn.habit
    yield "shrub", shrub(), Habit()
    yield "2,000 limbs", PipeRadii(Habit())(branching_tree(11_000)), Habit()


def row(name: str, tree: TreeSkeleton, habit: Habit, way: str) -> str:
    """One line of the table."""
    make = lambda: wood_of(tree, bark="oak", habit=habit, key=jax.random.key(0), wood=way)  # noqa: E731
    make()
    begin = time.perf_counter()
    wood = make()
    seconds = time.perf_counter() - begin
    found = audit(*together(wood.meshes))
    lines = centre_lines(tree, apart=is_frond(tree) if habit.leaf_arrangement == "frond" else None, onward=wood.made == "one-piece")
    off = off_forks(lines, wood.meshes)
    sunk = wood.warnings[0].split()[0] if wood.warnings else "0"
    return (
        f"{name:<16} {wood.made:<10} {len(lines):>6} {found['triangles']:>8} {found['parts']:>6} {int(tree.is_base.sum()):>5} {found['open']:>5} {found['nonmanifold']:>6} "
        f"{found['turned']:>6} {found['thin']:>6.2%} {off['off']:>7.2%} {off['beyond']:>8.3%} {off['stretched']:>9.2%} {off['tiles low']:>5.1f}-{off['tiles high']:<5.1f} {sunk:>4} {seconds:>7.2f}"
    )


def main(arguments: list[str]) -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.wood_audit", description=__doc__.splitlines()[0])
    parser.add_argument("--trees", nargs="*", help="only these")
    parser.add_argument("--ways", nargs="+", default=["one-piece", "tubes"], choices=["one-piece", "tubes"])
    options = parser.parse_args(arguments)
    print(f"{'tree':<16} {'wood':<10} {'limbs':>6} {'triangles':>8} {'parts':>6} {'bases':>5} {'open':>5} {'nonman':>6} {'turned':>6} {'thin':>6} {'off':>7} {'beyond':>8} {'stretched':>9} {'tiles/m':^11} {'sunk':>4} {'seconds':>7}")
    for name, tree, habit in trees():
        if not options.trees or name in options.trees:
            for way in options.ways:
                print(row(name, tree, habit, way), flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
