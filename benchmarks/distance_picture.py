"""Where does a tree lie off the points that it was made of? `python -m benchmarks.distance_picture -o PICTURE.png [--cloud POINTS]`: the mesh coloured by its distance from the scan, the scan by
its distance from the mesh, with a legend in millimetres and shares of the height.

Without a cloud, of a tree of ours: points on its bark as a scanner sees them from three places, with its noise (`scanned`).
"""

import argparse
from pathlib import Path

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from benchmarks.twenty_views.models import model
from sketchtree.cloud_tree import CloudTree, cloud_to_tree
from sketchtree.clouds.cloud import PointCloud
from sketchtree.fidelity.distance_colours import ramp
from sketchtree.fidelity.distance_file import RED
from sketchtree.fidelity.sampled import joined_triangles, over
from sketchtree.fidelity.scan_distance import mesh_to_scan, scan_to_mesh, vertices_to_scan
from sketchtree.keys import root_key
from sketchtree.options import TreeOptions

POINTS, NOISE = 120_000, 0.004  # points of the scan, metres
EYES = (0.35, 2.45, 4.5)  # radians: where the scanner stood
_INK, _QUIET, _PAPER = "#22262b", "#6b727b", "#ffffff"
_PIXELS = (1120, 1400)


def scanned(name: str = "wild_cherry") -> PointCloud:
    """A model as a laser scanner sees it from three places: the sides that are turned away from all of them have no points, near ones many."""
    mesh = model(name).mesh
    place = over([mesh], 4 * POINTS, key=root_key(1))
    position, triangle = joined_triangles([mesh])
    height, chance = float(np.ptp(position[:, 1])), np.random.default_rng(0)
    normal = np.cross(position[triangle[:, 1]] - position[triangle[:, 0]], position[triangle[:, 2]] - position[triangle[:, 0]])
    from scipy.spatial import cKDTree

    facing = normal[cKDTree(position[triangle].mean(axis=1)).query(place)[1]]
    facing /= np.linalg.norm(facing, axis=1, keepdims=True) + 1e-12
    seen = np.zeros(len(place), bool)
    for turn in EYES:
        eye = height * np.array([1.3 * np.cos(turn), 0.12, 1.3 * np.sin(turn)])
        way = (eye - place) / np.linalg.norm(eye - place, axis=1, keepdims=True)
        seen |= (np.einsum("pa,pa->p", way, facing) > 0.15) & _first(place, eye, 0.0009)
    place = place[seen]
    place = place[chance.permutation(len(place))[:POINTS]]
    return PointCloud(place + chance.normal(0, NOISE, place.shape))


def _first(place, eye, cell: float):
    """Which places are the nearest in their direction, of cells so many radians wide."""
    way = place - eye
    far = np.linalg.norm(way, axis=1)
    turn, lift = np.arctan2(way[:, 2], way[:, 0]), np.arcsin(way[:, 1] / far)
    _, number = np.unique(np.floor(np.c_[turn, lift] / cell).astype(np.int64), axis=0, return_inverse=True)
    nearest = np.full(number.max() + 1, np.inf)
    np.minimum.at(nearest, number.ravel(), far)
    return far < nearest[number.ravel()] + 0.06


def mesh_picture(meshes, colour, camera) -> np.ndarray:
    """The surface, each vertex in its colour, softly lit."""
    import pyvista

    position, triangle = joined_triangles(meshes)
    surface = pyvista.PolyData.from_regular_faces(position, triangle)
    surface["colour"] = np.round(255 * colour).astype(np.uint8)
    return _drawn(lambda scene: scene.add_mesh(surface, scalars="colour", rgb=True, ambient=0.62, diffuse=0.42, specular=0.0, smooth_shading=True), camera)


def points_picture(xyz, colour, camera) -> np.ndarray:
    """The points, each in its colour."""
    import pyvista

    cloud = pyvista.PolyData(np.asarray(xyz, float))
    cloud["colour"] = np.round(255 * colour).astype(np.uint8)
    return _drawn(lambda scene: scene.add_mesh(cloud, scalars="colour", rgb=True, point_size=3.2, lighting=False), camera)


def _drawn(add, camera) -> np.ndarray:
    import pyvista

    scene = pyvista.Plotter(off_screen=True, window_size=_PIXELS, lighting="three lights")
    scene.background_color = _PAPER
    scene.enable_anti_aliasing("ssaa")
    add(scene)
    scene.enable_parallel_projection()
    scene.camera_position = camera[:3]
    scene.camera.parallel_scale = camera[3]
    shot = scene.screenshot(return_img=True)
    scene.close()
    return shot


def framed(xyz):
    """(place, what it looks at, up, half the height that it sees) of a camera that holds all points, from the front and a little above."""
    low, high = xyz.min(axis=0), xyz.max(axis=0)
    middle, reach = 0.5 * (low + high), float(np.linalg.norm(high - low))
    return [tuple(middle + 2 * reach * np.array([0.33, 0.1, 1.0])), tuple(middle), (0.0, 1.0, 0.0), 0.512 * max(high[1] - low[1], (high[0] - low[0]) * _PIXELS[1] / _PIXELS[0])]


def picture(tree: CloudTree, path: Path) -> None:
    """Both ways beside one another."""
    xyz, wood = tree.prepared.cloud.xyz, [mesh for mesh in tree.model.meshes if mesh.name.startswith("wood")]
    there, back, every = scan_to_mesh(xyz, wood), vertices_to_scan(wood, xyz), mesh_to_scan(wood, xyz, key=root_key(2))
    most = RED * there.height
    camera = framed(xyz)
    shots = [mesh_picture(wood, ramp(back.metres / most), camera), points_picture(xyz, ramp(there.metres / most), camera)]
    titles = ("the tree, by its distance from the scan", "the scan, by its distance from the tree")
    told = [
        f"mean {1000 * every.mean:.0f} mm, {100 * every.share:.2f} % of the height; {100 * every.within(RED):.1f} % within 1.5 %",
        f"mean {1000 * there.mean:.0f} mm, {100 * there.share:.2f} % of the height; {100 * there.within(RED):.1f} % within 1.5 %",
    ]
    figure = plt.figure(figsize=(12.0, 8.9), facecolor=_PAPER)
    for k in range(2):
        place = figure.add_axes((0.01 + 0.495 * k, 0.12, 0.485, 0.81))
        place.imshow(shots[k])
        place.axis("off")
        figure.text(0.2525 + 0.495 * k, 0.955, titles[k], ha="center", color=_INK, fontsize=14)
        figure.text(0.2525 + 0.495 * k, 0.93, told[k], ha="center", color=_QUIET, fontsize=10.5)
    _legend(figure.add_axes((0.25, 0.078, 0.5, 0.02)), most)
    figure.text(0.5, 0.012, f"{len(xyz):,} points, {there.height:.1f} m high", ha="center", color=_QUIET, fontsize=10)
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=100, facecolor=_PAPER)
    plt.close(figure)


def _legend(place, most: float) -> None:
    place.imshow(ramp(np.linspace(0, 1, 256))[None], aspect="auto", extent=(0, 1, 0, 1))
    shares = np.linspace(0, RED, 4)
    place.set_yticks([])
    labels = [f"{1000 * share / RED * most:.0f} mm\n{100 * share:.1f} %" for share in shares]
    labels[0], labels[-1] = "on it\n0 %", labels[-1].replace(" mm", " mm and more")
    place.set_xticks(shares / RED, labels, fontsize=10, color=_INK)
    place.tick_params(length=3, color=_QUIET)
    for edge in place.spines.values():
        edge.set_visible(False)


def main() -> None:
    """Make the tree, measure, draw."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--out", type=Path, required=True)
    parser.add_argument("--cloud", type=Path, help="any file of points that `sketchtree cloud` reads")
    asked = parser.parse_args()
    picture(cloud_to_tree(asked.cloud or scanned(), key=root_key(0), tree=TreeOptions(leaf="none")), asked.out)


if __name__ == "__main__":
    main()
