"""Is a trunk's skeleton that of its shape, whatever the noise on its contour? Drawn trunks whose skeletons are known, ours beside scikit-image's.

    python -m benchmarks.trunk_noise                    the table
    python -m benchmarks.trunk_noise --trunks 4 --sizes 420
    python -m benchmarks.trunk_noise -o DIR             and pictures, one a noise level, and one of the vertices

A trunk is a union of round tapering limbs: a stem, limbs on it, twigs on those, none nearer to another than a few pixels, none that hardly leaves its parent's outline. Its contour is moved in and out by
noise: a random field, independent from pixel to pixel but for a Gaussian of σ 0.7 pixels, with a standard deviation of 0-2 pixels, is added to the signed distance.

    spurious   ends of the skeleton that are no end of the trunk, over its true branches        bar: 0.05 at 1 pixel
    missing    true ends that the skeleton does not reach, over its true branches               bar: 0.05 at 1 pixel
    loops      cycles that are left, a trunk
    axis       median distance of the skeleton from the true axes, pixels
    radius     median error of the radius there, pixels (ours and medial_axis)
    seconds    a trunk

An end is reached if one of the skeleton's is nearer than 3 pixels and one and a half radii of the limb's end; each true end is matched to one. The foot is an end as any other. Twigs that noise parts from the trunk
are missing for every method alike.
"""

import argparse
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw
from scipy.ndimage import convolve, distance_transform_edt, gaussian_filter, label
from scipy.optimize import linear_sum_assignment
from scipy.spatial import KDTree
from scipy.spatial.distance import cdist
from skimage.morphology import medial_axis, skeletonize

from sketchtree.trunk.edits import VertexEdits
from sketchtree.trunk.skeletonise import trunk_skeleton
from sketchtree.trunk.trunk_skeleton import TrunkSkeleton

NOISE = (0.0, 0.5, 1.0, 1.5, 2.0)  # pixels
SIZES = (420, 1500)  # pixels high
TRUNKS = 12
_ROUND = np.ones((3, 3), bool)


@dataclass(frozen=True, eq=False)
class Trunk:
    """A drawn trunk and its true skeleton; pixels, y down."""

    signed: np.ndarray  # (row, column): distance into the trunk, negative outside
    axes: list[np.ndarray]  # (point, 3): x, y, radius of each limb, from its foot
    ends: np.ndarray  # (end, 3): x, y, radius; the foot first

    @property
    def branches(self) -> int:
        return len(self.axes)


def trunk(seed: int, height: int = 420) -> Trunk:
    """One drawn trunk."""
    rng, scale = np.random.default_rng(seed), height / 420
    width = int(400 * scale)
    stem = _limb(rng, np.array([width * rng.uniform(0.42, 0.58), height + 12.0 * scale]), -np.pi / 2, 0.8 * height, rng.uniform(9, 14) * scale, 3.0 * scale)
    axes = [stem]
    for order, tries, share in ((1, 26, 0.42), (2, 60, 0.22)):
        for _ in range(tries):
            _try_limb(rng, axes, order, share * height, scale, (width, height))
    signed = _signed(axes, height, width)
    foot = stem[np.argmin(np.abs(stem[:, 1] - height))]
    ends = [np.array([foot[0], height, foot[2]])] + [line[-1] + [*_onward(line), 0.0] for line in axes]
    return Trunk(signed, axes, np.array(ends))


def _onward(line) -> np.ndarray:
    """From the last circle's middle to the end of the wood."""
    step = line[-1, :2] - line[-2, :2]
    return step / np.hypot(*step) * line[-1, 2]


def _limb(rng, at, heading: float, length: float, first: float, last: float) -> np.ndarray:
    """A wavering, tapering line: x, y, radius at every pixel."""
    count = max(int(length), 8)
    along = np.linspace(0.0, 1.0, count)
    angle = heading + rng.uniform(-0.5, 0.5) * along + rng.uniform(0.05, 0.2) * np.sin(2 * np.pi * rng.uniform(0.8, 2.0) * along)
    step = length / count * np.column_stack([np.cos(angle), np.sin(angle)])
    return np.column_stack([at + np.cumsum(step, axis=0), np.linspace(first, last, count)])


def _try_limb(rng, axes: list[np.ndarray], order: int, length: float, scale: float, size) -> None:
    """One limb more, if there is room for it."""
    host = axes[0] if order == 1 else axes[1 + rng.integers(len(axes) - 1)] if len(axes) > 1 else axes[0]
    row = int(len(host) * rng.uniform(0.3, 0.92))
    x, y, radius = host[row]
    along = np.arctan2(*(host[row, :2] - host[row - 3, :2])[::-1])
    first = max(radius * rng.uniform(0.4, 0.75), 4.0 * scale)
    line = _limb(rng, np.array([x, y]), along + rng.choice([-1, 1]) * np.radians(rng.uniform(35, 80)), length * rng.uniform(0.5, 1.2), first, max(first * 0.5, 3.4 * scale))
    margin = 10.0 * scale
    outside = (line[:, :2] < margin).any() or (line[:, 0] > size[0] - margin).any() or (line[:, 1] > size[1] - 40.0 * scale).any()
    free = line[np.hypot(*(line[:, :2] - [x, y]).T) > radius + first + margin]
    if outside or len(free) < 15 * scale:
        return
    others = np.concatenate(axes)
    near, which = KDTree(others[:, :2]).query(free[:, :2])
    if (near > free[:, 2] + others[which, 2] + 5.0 * scale).all():
        axes.append(line)


def _signed(axes, height: int, width: int) -> np.ndarray:
    """Depth within the union of all circles along all axes."""
    points = np.concatenate(axes)
    y, x = np.mgrid[0:height, 0:width] + 0.5
    depth = np.full((height, width), -np.inf)
    for px, py, r in points:
        reach = r + 8.0
        rows, columns = slice(max(int(py - reach), 0), max(int(py + reach) + 1, 0)), slice(max(int(px - reach), 0), max(int(px + reach) + 1, 0))
        near = r - np.hypot(x[rows, columns] - px, y[rows, columns] - py)
        np.maximum(depth[rows, columns], near, out=depth[rows, columns])
    return np.where(np.isfinite(depth), depth, -8.0)


def noisy(one: Trunk, sd: float, seed: int) -> np.ndarray:
    """The trunk's mask with a contour moved by noise of this standard deviation, pixels."""
    field = gaussian_filter(np.random.default_rng(seed).normal(size=one.signed.shape), 0.7)
    return one.signed + sd * field / field.std() > 0.0


@dataclass(frozen=True, eq=False)
class Found:
    """A skeleton by any method."""

    points: np.ndarray
    ends: np.ndarray
    radius: np.ndarray | None
    loops: int


def ours(mask: np.ndarray) -> Found:
    skeleton = trunk_skeleton(mask.astype(np.float64))
    a, b = skeleton.edges.T
    steps = np.linspace(0.0, 1.0, 5)[:, None, None]
    points = (skeleton.xy[a] * (1 - steps) + skeleton.xy[b] * steps).reshape(-1, 2)
    radius = (skeleton.radius[a] * (1 - steps[..., 0]) + skeleton.radius[b] * steps[..., 0]).ravel()
    return Found(points, skeleton.xy[[skeleton.root, *skeleton.tips]], radius, 0)


def pixels(lines: np.ndarray, mask: np.ndarray) -> Found:
    """Of a skeleton of pixels: the largest piece, its pixels with one neighbour."""
    parts, count = label(lines, _ROUND)
    lines = parts == 1 + np.argmax(np.bincount(parts.ravel())[1:]) if count else lines
    neighbours = convolve(lines.astype(int), np.ones((3, 3), int), mode="constant") - 1
    place = np.argwhere(lines)
    ends = np.argwhere(lines & (neighbours <= 1))
    holes = label(~np.pad(lines, 1))[1] - 1
    return Found(place[:, ::-1] + 0.5, ends[:, ::-1] + 0.5, distance_transform_edt(np.pad(mask, 1))[1:-1, 1:-1][lines], holes)


METHODS = {
    "ours": ours,
    "skeletonize": lambda mask: pixels(skeletonize(mask), mask),
    "skeletonize lee": lambda mask: pixels(skeletonize(mask, method="lee") > 0, mask),
    "medial_axis": lambda mask: pixels(medial_axis(mask, rng=0), mask),
}


def score(one: Trunk, found: Found) -> dict[str, float]:
    """The columns of the table, sums over branches not divided yet."""
    distance = cdist(one.ends[:, :2], found.ends) if len(found.ends) else np.full((len(one.ends), 1), np.inf)
    cost = np.where(distance <= 3.0 + 1.5 * one.ends[:, 2:], distance, 1e6)
    rows, columns = linear_sum_assignment(cost)
    matched = int((cost[rows, columns] < 1e6).sum())
    truth = np.concatenate(one.axes)
    off, nearest = KDTree(truth[:, :2]).query(found.points)
    return {
        "spurious": len(found.ends) - matched,
        "missing": len(one.ends) - matched,
        "loops": found.loops,
        "axis": float(np.median(off)),
        "radius": float(np.median(np.abs(found.radius - truth[nearest, 2]))),
    }


def table(size: int, trunks: int, levels=NOISE, methods=METHODS) -> list[dict]:
    """One row a noise level and method."""
    drawn = [trunk(1000 + k, size) for k in range(trunks)]
    rows = []
    for sd in levels:
        masks = [noisy(one, sd, 7 + k) for k, one in enumerate(drawn)]
        for name, method in methods.items():
            begun = time.process_time()
            found = [method(mask) for mask in masks]
            seconds = (time.process_time() - begun) / trunks
            scores = [score(one, skeleton) for one, skeleton in zip(drawn, found, strict=True)]
            branches = sum(one.branches for one in drawn)
            row = {key: sum(s[key] for s in scores) / branches for key in ("spurious", "missing")}
            row |= {key: float(np.mean([s[key] for s in scores])) for key in ("loops", "axis", "radius")}
            rows.append({"size": size, "noise": sd, "method": name, "branches": branches, **row, "seconds": seconds})
    return rows


def vertices_picture(one: Trunk, mask: np.ndarray) -> Image.Image:
    """As Figure 4: thinning and the whole medial axis; ours with few vertices, with as many as the noise allows, and with the segments about the leftmost limb merged by hand."""
    alpha = mask.astype(np.float64)
    whole = trunk_skeleton(alpha)
    ring = whole.vertices[0]
    tip = ring[int(np.argmin(ring[:, 0]))]
    order = np.roll(np.arange(len(ring)), -int(np.argmin(ring[:, 0])))
    edits = VertexEdits(merge=((tuple(ring[order[-2]]), tuple(ring[order[2]])),)) if len(ring) > 8 else VertexEdits(remove=(tuple(tip),))
    thin = [Image.fromarray(np.where(lines, 0, np.where(mask, 170, 255)).astype(np.uint8)) for lines in (skeletonize(mask), medial_axis(mask, rng=0))]
    size = (2 * mask.shape[1], 2 * mask.shape[0])
    panels = [lines.resize(size, Image.Resampling.NEAREST).convert("RGB") for lines in thin]
    panels += [picture(one, mask, trunk_skeleton(alpha, vertices=20)), picture(one, mask, whole), picture(one, mask, trunk_skeleton(alpha, edits=edits))]
    sheet = Image.new("RGB", (size[0] * len(panels), size[1]), "white")
    for k, panel in enumerate(panels):
        sheet.paste(panel, (k * size[0], 0))
    return sheet


def picture(one: Trunk, mask: np.ndarray, skeleton: TrunkSkeleton, scale: int = 2) -> Image.Image:
    """The mask, the evolved polygon with its parting vertices, the skeleton, the true ends."""
    image = Image.fromarray(np.where(mask, 120, 255).astype(np.uint8)).resize((mask.shape[1] * scale, mask.shape[0] * scale), Image.Resampling.NEAREST).convert("RGB")
    pen = ImageDraw.Draw(image)
    for ring, parting in zip(skeleton.vertices, skeleton.parting, strict=True):
        pen.line([tuple(point) for point in scale * np.concatenate([ring, ring[:1]])], fill=(70, 110, 255))
        for (x, y), parts in zip(scale * ring, parting, strict=True):
            pen.ellipse([x - 3, y - 3, x + 3, y + 3], fill=(255, 140, 0) if parts else (70, 110, 255))
    for a, b in skeleton.edges:
        pen.line([*(scale * skeleton.xy[a]), *(scale * skeleton.xy[b])], fill=(210, 0, 0), width=2)
    for x, y, _ in scale * one.ends:
        pen.ellipse([x - 6, y - 6, x + 6, y + 6], outline=(0, 130, 60), width=2)
    return image


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--trunks", type=int, default=TRUNKS)
    parser.add_argument("--sizes", type=int, nargs="+", default=SIZES)
    parser.add_argument("--noise", type=float, nargs="+", default=NOISE)
    parser.add_argument("-o", "--out", type=Path)
    asked = parser.parse_args()
    missed = False
    print(f"{'size':>5} {'noise':>5}  {'method':16} {'branches':>8} {'spurious':>8} {'missing':>8} {'loops':>6} {'axis':>6} {'radius':>6} {'seconds':>8}")
    for size in asked.sizes:
        for row in table(size, asked.trunks, asked.noise):
            missed |= row["method"] == "ours" and row["noise"] <= 1.0 and max(row["spurious"], row["missing"]) > 0.05
            print("{size:5} {noise:5.1f}  {method:16} {branches:8} {spurious:8.3f} {missing:8.3f} {loops:6.2f} {axis:6.2f} {radius:6.2f} {seconds:8.3f}".format(**row))
    if asked.out:
        asked.out.mkdir(parents=True, exist_ok=True)
        one = trunk(1000)
        for sd in asked.noise:
            mask = noisy(one, sd, 7)
            picture(one, mask, trunk_skeleton(mask.astype(np.float64))).save(asked.out / f"trunk_noise_{sd:g}.png")
        vertices_picture(one, noisy(one, 1.0, 7)).save(asked.out / "trunk_vertices.png")
    sys.exit(1 if missed else 0)


if __name__ == "__main__":
    main()
