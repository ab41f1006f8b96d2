"""Point clouds that almost make sense: mutants of valid files, and valid files of points that are no tree. Same generator, same file.

    points     missing, endless, huge, all at one place, in a line, in a plane, twice, none, turned, in millimetres, far from the origin
    heads      a number or a word of the head replaced, a byte of it changed
    bytes      flips, cuts, copies
"""

import importlib.util
import io
import re
import struct

import numpy as np

from sketchtree.clouds.cloud import PointCloud
from sketchtree.clouds.files.write_cloud import ply_bytes

CLOUDS = ("ply", "las", "laz", "xyz", "csv", "npz", "npy")
_NUMBERS = b"0 -1 1 3 255 65536 4294967295 18446744073709551615 1e400 nan -inf 0.0000001 --1 1,5 0x10".split() + [b"9" * 300, b""]
_WORDS = b"float double uchar int list uchar,int ascii binary_big_endian vertex face x y z red nx comment element property end_header # // ; , \t \0".split()
_LAS = 227  # bytes of its head


def points(rng: np.random.Generator, count: int = 400) -> np.ndarray:
    """Points on a trunk with three limbs, metres, y up."""
    found = []
    for foot, tip, thick in (((0, 0, 0), (0, 3, 0), 0.1), ((0, 1.2, 0), (1, 2, 0.2), 0.04), ((0, 1.6, 0), (-0.9, 2.6, 0.4), 0.04), ((0, 2, 0), (0.2, 2.8, -0.9), 0.03)):
        along = rng.random((count // 4, 1))
        out = rng.normal(size=(count // 4, 3))
        found.append(np.array(foot) + along * np.subtract(tip, foot) + thick * (1 - 0.6 * along) * out / np.linalg.norm(out, axis=1, keepdims=True))
    return np.concatenate(found)


def no_tree(xyz: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """The points, or others in their place."""
    way = int(rng.integers(14))
    some = rng.random(len(xyz)) < (1.0 if rng.random() < 0.2 else 0.1)
    if way < 3:
        xyz[some, int(rng.integers(3))] = (np.nan, np.inf, -np.inf, 1e300, -1e15, 1e-320)[int(rng.integers(6))]
    elif way == 3:
        xyz[:] = xyz[0]
    elif way == 4:
        xyz = xyz * np.eye(3)[int(rng.integers(3))]
    elif way == 5:
        xyz = xyz * (1 - np.eye(3)[int(rng.integers(3))])
    elif way == 6:
        xyz = np.repeat(xyz, int(rng.integers(2, 5)), axis=0)
    elif way == 7:
        xyz = xyz[: int(rng.integers(0, 130))]
    elif way == 8:
        xyz = xyz @ np.linalg.qr(rng.normal(size=(3, 3)))[0]
    elif way == 9:
        xyz = xyz * 10.0 ** rng.integers(-9, 12)
    elif way == 10:
        xyz = xyz + rng.choice([1e3, 1e6, 1e9, -1e12], 3)
    elif way == 11:
        xyz = np.concatenate([xyz + 4.0 * k * np.array([1, 0, 0]) for k in range(int(rng.integers(2, 14)))])
    elif way == 12:
        xyz = rng.normal(size=xyz.shape) if rng.random() < 0.5 else np.round(xyz, int(rng.integers(0, 2)))
    return xyz


def file_of(kind: str, xyz: np.ndarray, rng: np.random.Generator) -> bytes:
    """The points as a file."""
    with np.errstate(over="ignore", invalid="ignore"):
        if kind == "ply":
            return _ply(xyz, rng)
        if kind in ("las", "laz"):
            return _las(xyz, kind == "laz")
        if kind in ("xyz", "csv"):
            more = rng.integers(0, 256, (len(xyz), 3)) if rng.random() < 0.5 else np.empty((len(xyz), 0))
            out, comma = io.StringIO(), kind == "csv"
            np.savetxt(out, np.c_[xyz, more], fmt="%.9g", delimiter="," if comma else " ", comments="", header="x,y,z" + ",red,green,blue" * (more.shape[1] > 0) if comma else "")
            return out.getvalue().encode()
        out = io.BytesIO()
        if kind == "npz":
            np.savez_compressed(out, xyz=xyz, rgb=rng.integers(0, 256, xyz.shape).astype(np.uint8))
        else:
            np.save(out, xyz if rng.random() < 0.7 else xyz.astype(np.float32))
        return out.getvalue()


def mutant(kind: str, rng: np.random.Generator) -> bytes:
    """One file of a kind of cloud that a scanner would not write."""
    data = file_of(kind, no_tree(points(rng), rng), rng)
    if rng.random() < 0.35:
        return data  # a sound file of odd points
    for _ in range(int(rng.integers(1, 4))):
        data = _head(data, kind, rng) if rng.random() < 0.6 else _bytes(data, rng)
    return data


def _ply(xyz: np.ndarray, rng: np.random.Generator) -> bytes:
    if rng.random() < 0.5 and len(xyz) and np.isfinite(xyz).all():
        return ply_bytes(PointCloud(xyz, rng.random(xyz.shape) if rng.random() < 0.5 else None))
    lists = rng.random() < 0.3
    head = ["ply", "format ascii 1.0", f"element vertex {len(xyz)}", "property float x", "property float y", "property float z"]
    head += ["property list uchar int at"] * lists + ["element face 1", "property list uchar int vertex_indices", "end_header"]
    return "\n".join([*head, *(f"{a:.7g} {b:.7g} {c:.7g}{' 2 0 1' * lists}" for a, b, c in xyz), "3 0 1 2", ""]).encode()


def _las(xyz: np.ndarray, packed: bool) -> bytes:
    """LAS 1.2 with records of 20 bytes; packed where lazrs is there."""
    packed = packed and importlib.util.find_spec("lazrs") is not None
    note = how = b""
    if packed:
        import lazrs

        how = lazrs.LazVlr.new_for_compression(0, 0)
        held = how.record_data()
        note = struct.pack("<H16sHH32s", 0, b"laszip encoded", 22204, len(held), b"") + held
    head = bytearray(_LAS)
    head[:4], head[24:26] = b"LASF", bytes((1, 2))
    struct.pack_into("<HIIBHI", head, 94, _LAS, _LAS + len(note), int(packed), 128 * packed, 20, len(xyz))
    struct.pack_into("<6d", head, 131, *(0.001,) * 3, *(0.0,) * 3)
    rows = np.zeros((len(xyz), 20), np.uint8)
    rows[:, :12] = np.ascontiguousarray(np.nan_to_num(np.clip(xyz[:, [0, 2, 1]] / 0.001, -2e9, 2e9)).astype("<i4")).view(np.uint8)
    if not packed:
        return bytes(head) + note + rows.tobytes()
    out = io.BytesIO()
    out.write(bytes(head) + note)
    packer = lazrs.LasZipCompressor(out, how)
    packer.compress_many(rows.ravel())
    packer.done()
    return out.getvalue()


def _head(data: bytes, kind: str, rng: np.random.Generator) -> bytes:
    """A number, a word or a byte near the beginning is another."""
    if kind in ("las", "laz", "npy", "npz") and data:
        found = bytearray(data)
        for _ in range(int(rng.integers(1, 4))):
            at = int(rng.integers(min(len(found), 400)))
            found[at] = int(rng.integers(256)) if rng.random() < 0.6 else (0, 1, 127, 255)[int(rng.integers(4))]
        return bytes(found)
    words = list(re.finditer(rb"[^\s,]+", data[:600]))
    if not words:
        return data
    hit = words[int(rng.integers(len(words)))]
    pool = _NUMBERS if hit.group()[:1].isdigit() or rng.random() < 0.3 else _WORDS
    return data[: hit.start()] + pool[int(rng.integers(len(pool)))] + data[hit.end() :]


def _bytes(data: bytes, rng: np.random.Generator) -> bytes:
    a, b = sorted(int(k) for k in rng.integers(0, max(len(data), 1), 2))
    b = min(b, a + 400)
    way = int(rng.integers(4))
    if way == 0:
        return data[:a]
    if way == 1:
        return data[:a] + data[b:]
    if way == 2:
        return data[:b] + data[a:b] * int(rng.integers(1, 20)) + data[b:]
    found = bytearray(data)
    for at in rng.integers(0, len(found), int(rng.integers(1, 9))) if found else ():
        found[at] ^= 1 << int(rng.integers(8))
    return bytes(found)
