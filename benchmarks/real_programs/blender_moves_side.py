"""Run by Blender's own Python: import one file that moves, set moments, and keep where the vertices are then.

    python blender_moves_side.py FILE SECONDS,SECONDS… OUT.npz [PICTURE.png]

OUT holds `K/NAME`, the vertices of a mesh at the K-th moment, y up. Prints as JSON how long the import and a frame took.
"""

import json
import sys
import time
from pathlib import Path

import bpy
import numpy as np


def main(path: str, moments: list[float], out: str, picture: str | None) -> dict:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    begun = time.perf_counter()
    if Path(path).suffix.lower() in (".glb", ".gltf"):
        bpy.ops.import_scene.gltf(filepath=path)
    else:
        bpy.ops.wm.usd_import(filepath=path)
    imported = time.perf_counter() - begun
    scene, kept, frames = bpy.context.scene, {}, []
    rate = scene.render.fps / scene.render.fps_base
    for k, second in enumerate(moments):
        begun = time.perf_counter()
        frame = second * rate
        scene.frame_set(int(frame // 1), subframe=frame % 1)
        graph = bpy.context.evaluated_depsgraph_get()
        frames.append(time.perf_counter() - begun)
        for thing in bpy.data.objects:
            if thing.type == "MESH" and thing.name in scene.objects:
                kept[f"{k}/{thing.data.name}"] = _places(thing.evaluated_get(graph))
    np.savez(out, **kept)
    if picture:
        _draw(picture)
    bones = sum(len(thing.data.bones) for thing in bpy.data.objects if thing.type == "ARMATURE")
    return {"program": f"Blender {bpy.app.version_string}", "import": imported, "frame": float(np.median(frames)), "bones": bones}


def _places(thing):
    mesh = thing.data
    place = np.zeros(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", place)
    world = np.array(thing.matrix_world)
    place = place.reshape(-1, 3) @ world[:3, :3].T + world[:3, 3]
    return np.stack([place[:, 0], place[:, 2], -place[:, 1]], axis=1).astype(np.float32)


def _draw(picture: str) -> None:
    """By Cycles on the processor, few samples."""
    from mathutils import Vector

    scene = bpy.context.scene
    corners = [thing.matrix_world @ Vector(corner) for thing in scene.objects if thing.type == "MESH" for corner in thing.bound_box]
    high = max(corner.z for corner in corners)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location, camera.rotation_euler = (0, -2.4 * high, 0.55 * high), (np.pi / 2, 0, 0)
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    sun.data.energy, sun.rotation_euler = 4.0, (0.7, 0.2, 0.6)
    scene.collection.objects.link(camera)
    scene.collection.objects.link(sun)
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs[0].default_value = (0.7, 0.8, 0.9, 1)
    scene.camera, scene.render.engine, scene.cycles.samples, scene.cycles.device = camera, "CYCLES", 12, "CPU"
    scene.render.resolution_x = scene.render.resolution_y = 480
    scene.render.filepath = picture
    bpy.ops.render.render(write_still=True)


if __name__ == "__main__":
    given = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else sys.argv[1:]
    print("SEEN " + json.dumps(main(str(Path(given[0]).resolve()), [float(second) for second in given[1].split(",")], given[2], given[3] if len(given) > 3 else None)))
