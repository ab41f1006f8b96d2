"""Run by Blender's own Python: import one file into an empty scene and print, as JSON, what is in it then.

    python blender_side.py FILE [PICTURE.png]      with a `bpy` from PyPI, 5.0 or later
    blender -b -P blender_side.py -- FILE          with a Blender that is installed

World bounds are turned back from Blender's z up to y up.
"""

import json
import sys
from pathlib import Path

import bpy
import numpy as np


def seen_in(path: Path) -> dict:
    """Triangles drawn (instances counted), materials in use, bounds with y up."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    wm, scene = bpy.ops.wm, bpy.ops.import_scene
    importers = {".glb": scene.gltf, ".gltf": scene.gltf, ".obj": wm.obj_import, ".ply": wm.ply_import, ".stl": wm.stl_import}
    told = {"up_axis": "Y", "forward_axis": "NEGATIVE_Z"} if path.suffix.lower() in (".ply", ".stl") else {}  # they don't say
    importers.get(path.suffix.lower(), wm.usd_import)(filepath=str(path), **told)
    graph = bpy.context.evaluated_depsgraph_get()
    triangles, low, high, known, materials = 0, np.full(3, np.inf), np.full(3, -np.inf), {}, set()
    for instance in graph.object_instances:
        thing = instance.object
        if thing.type != "MESH":
            continue
        if thing.data.name not in known:
            known[thing.data.name] = _measured(thing.data)
        count, place = known[thing.data.name]
        triangles += count
        materials |= {slot.name for slot in thing.data.materials if slot}
        world = np.array(instance.matrix_world)
        corners = place @ world[:3, :3].T + world[:3, 3]
        low, high = np.minimum(low, corners.min(axis=0)), np.maximum(high, corners.max(axis=0))
    turn = lambda v: [float(v[0]), float(v[2]), float(-v[1])]  # noqa: E731
    bounds = np.sort([turn(low), turn(high)], axis=0).tolist() if triangles else [[0.0] * 3] * 2
    bones = sum(len(thing.data.bones) for thing in bpy.data.objects if thing.type == "ARMATURE")
    return {"program": f"Blender {bpy.app.version_string}", "triangles": triangles, "materials": sorted(materials), "bounds": bounds, "bones": bones}


def _measured(mesh):
    mesh.calc_loop_triangles()
    place = np.zeros(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", place)
    place = place.reshape(-1, 3)
    return len(mesh.loop_triangles), place if len(place) else np.zeros((1, 3))


if __name__ == "__main__":
    given = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else sys.argv[1:]
    print("SEEN " + json.dumps(seen_in(Path(given[0]).resolve())))
