"""How near to scans do their trees lie? Scans and cylinder models of others, read in place: a table for `docs/clouds.md`.

    python -m benchmarks.clouds --shared DIR [--method traced|grown] [--lod N | --triangles N]

AdTree's `tree1` has 245,920 triangles; a tenth of that is `--triangles 24592`. `known` is what cylinder models of the same scans say: the trunk's diameter at the foot, and the length of all wood thicker than 2 cm.
"""

import argparse
import time
from pathlib import Path

import numpy as np

from sketchtree.cloud_tree import CloudOptions, cloud_to_tree
from sketchtree.fidelity.scan_distance import mesh_to_scan, scan_to_mesh
from sketchtree.keys import root_key
from sketchtree.levels.make import level_of_detail, within_triangles

SCANS = ("adtree_tree1", "adtree_tree13", "adtree_lille2", "archi_tree1", "rtwig_cloud")
ADTREE = {"adtree_tree1": "0.016, 0.034", "adtree_tree13": "0.050, 0.100", "adtree_lille2": "0.046, 0.078"}  # metres, scan → mesh, mesh → scan
KNOWN = {"archi_tree1": "qsm_archi_tree1", "rtwig_cloud": "qsm_rtwig"}
THICK = 0.01  # metres: radius of the wood that lengths are compared of


def row(shared: Path, name: str, method: str, lod: int, triangles: int | None) -> str:
    """One line of the table."""
    began = time.process_time()
    tree = cloud_to_tree(shared / "pointclouds" / f"{name}.ply", key=root_key(0), wanted=CloudOptions(method=method))
    took = time.process_time() - began
    wood = [mesh for mesh in (within_triangles(tree.model, triangles) if triangles else level_of_detail(tree.model, lod)) if mesh.name.startswith("wood")]
    xyz = tree.prepared.cloud.xyz
    there, back = scan_to_mesh(xyz, wood), mesh_to_scan(wood, xyz, key=root_key(1))
    line = [name, f"{len(xyz):,}", f"{there.mean:.4f}", f"{100 * there.share:.2f} %", f"{100 * there.within(0.015):.1f} %", f"{back.mean:.4f}", ADTREE.get(name, "")]
    line += [f"{sum(mesh.triangle_count for mesh in wood):,}", f"{took:.1f} s", known(shared, name, tree)]
    return "| " + " | ".join(line) + " |"


def known(shared: Path, name: str, tree) -> str:
    """Diameter of the trunk and length of thick wood, ours / the cylinder model's."""
    if name not in KNOWN:
        return ""
    with np.load(shared / "skeletons" / f"{KNOWN[name]}.npz") as file:
        parent, place, radius = file["parent"], file["pos"], file["radius"]
    length = np.where(parent < 0, 0.0, np.linalg.norm(place - place[parent], axis=1))
    low = place[:, 1] < place[:, 1].min() + 0.06 * np.ptp(place[:, 1])
    skeleton = tree.skeleton
    ours, theirs = skeleton.length[skeleton.radius > THICK].sum(), length[radius > THICK].sum()
    trunk = tree.trunks[0]
    return f"trunk {trunk.root if trunk else float('nan'):.3f} / {2 * np.median(radius[low & (radius > 0.7 * radius.max())]):.3f} m, wood over 2 cm {ours:.0f} / {theirs:.0f} m"


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--shared", type=Path, required=True, help="the folder with `pointclouds` and `skeletons`")
    parser.add_argument("--method", default="traced")
    parser.add_argument("--lod", type=int, default=0)
    parser.add_argument("--triangles", type=int, help="so many at most, where a level of detail is not what is asked")
    asked = parser.parse_args()
    print("| scan | points | scan → mesh | of the height | within 1.5 % | mesh → scan | AdTree | triangles | CPU | known |\n|" + " --- |" * 10)
    for name in SCANS:
        print(row(asked.shared, name, asked.method, asked.lod, asked.triangles), flush=True)


if __name__ == "__main__":
    main()
