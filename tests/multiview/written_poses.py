"""Cameras as COLMAP, instant-ngp and Bundler write them."""

import json
import struct

import numpy as np
from scipy.spatial.transform import Rotation

_FLIP = np.diag([1.0, -1.0, -1.0])


def colmap_text(folder, cameras, points, numbers=None):
    """cameras.txt, images.txt, points3D.txt; every photo sees all points. `numbers`: model and numbers in the place of PINHOLE's."""
    folder.mkdir(parents=True, exist_ok=True)
    lines = ["# Camera list"]
    for k, camera in enumerate(cameras, 1):
        own = numbers or ("PINHOLE", [camera.matrix[0, 0], camera.matrix[1, 1], *camera.matrix[:2, 2]])
        lines.append(f"{k} {own[0]} {camera.size[0]} {camera.size[1]} {' '.join(map(repr, map(float, own[1])))}")
    (folder / "cameras.txt").write_text("\n".join(lines))
    lines = ["# Image list"]
    for k, camera in enumerate(cameras, 1):
        lines.append(f"{k} {' '.join(repr(float(x)) for x in _pose(camera))} {k} photo {k}.jpg")
        lines.append(" ".join(f"1.0 2.0 {n}" for n in [-1, *range(10, 10 + len(points))]))
    (folder / "images.txt").write_text("\n".join(lines))
    (folder / "points3D.txt").write_text("\n".join(f"{n} {x!r} {y!r} {z!r} 1 2 3 0.5 1 1 2 1" for n, (x, y, z) in enumerate(points.tolist(), 10)))


def colmap_binary(folder, cameras, points):
    """The same as bytes."""
    folder.mkdir(parents=True, exist_ok=True)
    data = struct.pack("<Q", len(cameras))
    for k, camera in enumerate(cameras, 1):
        data += struct.pack("<iiQQ4d", k, 1, *camera.size, camera.matrix[0, 0], camera.matrix[1, 1], *camera.matrix[:2, 2])
    (folder / "cameras.bin").write_bytes(data)
    data = struct.pack("<Q", len(cameras))
    for k, camera in enumerate(cameras, 1):
        data += struct.pack("<i7di", k, *_pose(camera), k) + f"photo {k}.jpg".encode() + b"\0" + struct.pack("<Q", len(points) + 1)
        data += b"".join(struct.pack("<ddq", 1.0, 2.0, n) for n in [-1, *range(10, 10 + len(points))])
    (folder / "images.bin").write_bytes(data)
    data = struct.pack("<Q", len(points))
    for n, xyz in enumerate(points, 10):
        data += struct.pack("<Q3d3BdQ", n, *xyz, 1, 2, 3, 0.5, 1) + struct.pack("<ii", 1, 0)
    (folder / "points3D.bin").write_bytes(data)


def transforms(path, cameras):
    """A transforms.json; the world of `cameras` is taken as it is."""
    frames = []
    for k, camera in enumerate(cameras, 1):
        pose = np.eye(4)
        pose[:3, :3], pose[:3, 3] = camera.rotation.T @ _FLIP, camera.centre
        frames.append({"file_path": f"./images/photo {k}", "transform_matrix": pose.tolist()})
    camera = cameras[0]
    path.write_text(json.dumps({"fl_x": camera.matrix[0, 0], "fl_y": camera.matrix[1, 1], "cx": camera.matrix[0, 2], "cy": camera.matrix[1, 2], "k1": 0.01, "frames": frames}))


def bundler(path, cameras, points):
    """A bundle.out whose first camera could not be placed; the first point is seen by all."""
    lines = ["# Bundle file v0.3", f"{len(cameras) + 1} {len(points)}", "0 0 0", *["0 0 0"] * 4]
    for camera in cameras:
        turn = _FLIP @ camera.rotation
        rows = [[camera.matrix[0, 0], 0.02, 0.0], *turn.tolist(), (-turn @ camera.centre).tolist()]
        lines += [" ".join(repr(float(x)) for x in row) for row in rows]
    for k, xyz in enumerate(points):
        seen_by = range(1, len(cameras) + 1) if k == 0 else [1]
        lines += [" ".join(repr(float(x)) for x in xyz), "1 2 3", f"{len(seen_by)} " + " ".join(f"{n} 7 0.5 0.5" for n in seen_by)]
    path.write_text("\n".join(lines) + "\n")


def _pose(camera):
    x, y, z, w = Rotation.from_matrix(camera.rotation).as_quat()
    return [w, x, y, z, *(-camera.rotation @ camera.centre)]
