"""How heavy is a growing tree, and how true to its plan? `python -m benchmarks.animation [DRAWING...]`

For each drawing of `examples/` and each of three growths a row: joints and keys, the file's size, seconds of CPU for the motion and for one pose, how far the final meshes
are from those given, and how far the highest wood and the joints at nodes are from the plan between times (share of the tree's height).
"""

import sys
import time
from pathlib import Path

import numpy as np

from sketchtree.animation.growing import Growing
from sketchtree.animation.posing import joint_frames
from sketchtree.export.gltf import asset_bytes
from sketchtree.growth.plan import GrowthPlan
from sketchtree.keys import root_key
from sketchtree.pipeline import sketch_to_tree

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"
GROWTHS = (("age", 0.0), ("full", 0.0), ("full", -20.0))
TIMES = (0.07, 0.21, 0.38, 0.55, 0.73, 0.88)


def row(model, mode: str, bend: float) -> dict:
    """Everything measured of one growth."""
    began = time.process_time()
    growing = Growing.of(model, GrowthPlan.of(model.skeleton, mode=mode, bend=bend))
    asset = growing.asset(seconds=1.0)
    made = time.process_time() - began
    began = time.process_time()
    tops = [_top(growing.at(now)) for now in TIMES]
    posing = (time.process_time() - began) / len(TIMES)
    height = model.skeleton.height
    planned = [float(growing.plan.at(now).tip[:, 1].max()) for now in TIMES]
    keys = asset.animation
    return {
        "joints": len(asset.armature),
        "keys": sum(len(one.time) for one in (keys.translation, keys.rotation, keys.scale)),
        "megabytes": round(len(asset_bytes(asset)) / 1e6, 1),
        "motion_s": round(made, 2),
        "pose_s": round(posing, 2),
        "end_off": float(max(_off(growing, model))) if bend == 0 else None,
        "top_off": round(float(np.abs(np.subtract(tops, planned)).max()) / height, 4),
        "node_off": round(_nodes_off(growing, asset) / height, 5),
    }


def _top(meshes) -> float:
    return max(float(mesh.position[np.unique(mesh.triangle), 1].max()) for mesh in meshes if mesh.name.startswith("wood") and mesh.triangle_count)


def _off(growing: Growing, model):
    end = {mesh.name: mesh for mesh in growing.at(1.0)}
    for mesh in model.meshes:
        if mesh.name.startswith("wood"):
            yield np.abs(end[mesh.name].position[: len(mesh.position)] - mesh.position).max()


def _nodes_off(growing: Growing, asset) -> float:
    """The farthest that a joint at a node is from where the plan has that node, metres."""
    limb = np.repeat(np.arange(len(growing.lines)), growing.nodes.count)
    rank = np.arange(len(limb)) - growing.nodes.start[limb]
    by_nodes = growing.hosts.by_nodes[limb]
    ground = int(np.sum(growing.plan.tree.is_base))
    joint = 1 + ground + growing.hosts.first[limb[by_nodes]] + 1 + rank[by_nodes]
    poses = growing.plan.poses(TIMES, pieces=True)
    frames = [joint_frames(asset.armature, asset.animation, now)[0][joint, :3, 3] for now in TIMES]
    return max(float(np.abs(frame - tip[growing.nodes.piece[by_nodes]]).max()) for frame, tip in zip(frames, poses.tip, strict=True))


def main(names: list[str]) -> None:
    """Prints a table."""
    for name in names or ["oak.svg", "willow.svg", "spruce.svg", "palm.svg"]:
        model = sketch_to_tree(EXAMPLES / name, key=root_key(0))
        for mode, bend in GROWTHS:
            print(name, mode, f"{bend:g}", row(model, mode, bend), flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
