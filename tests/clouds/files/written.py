"""Point clouds as other programs write them, byte by byte."""

import io
import struct

import numpy as np

SIZES = (20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67)  # bytes of a LAS record, by its format
COLOURS = {2: 20, 3: 28, 5: 28, 7: 30, 8: 30, 10: 30}  # where its colour begins


def points(count: int = 50, seed: int = 0) -> np.ndarray:
    """Points of no tree, that 32 bits hold exactly."""
    return np.random.default_rng(seed).normal(size=(count, 3)).astype(np.float32).astype(np.float64)


def ply(properties: list[tuple[str, str, np.ndarray]], order: str = "<", *, before: bytes = b"", count: int | None = None, after: bytes = b"", head: str = "") -> bytes:
    """A binary PLY file: (type in the file, name, column) for each property. `before`: records of an element that stands first, as bytes."""
    kinds = {"float": "f4", "double": "f8", "uchar": "u1", "ushort": "u2", "int": "i4"}
    rows = np.empty(len(properties[0][2]), [(name, order + kinds[kind]) for kind, name, _ in properties])
    for _, name, column in properties:
        rows[name] = column
    lines = ["ply", f"format binary_{'little' if order == '<' else 'big'}_endian 1.0", *head.splitlines(), f"element vertex {len(rows) if count is None else count}"]
    lines += [f"property {kind} {name}" for kind, name, _ in properties]
    tail = "element face 2\nproperty list uchar int vertex_indices\n" if after else ""
    return ("\n".join(lines) + "\n" + tail + "end_header\n").encode() + before + rows.tobytes() + after


def place(xyz: np.ndarray, kind: str = "float") -> list[tuple[str, str, np.ndarray]]:
    """The properties x, y, z."""
    return [(kind, name, xyz[:, k]) for k, name in enumerate("xyz")]


def las(
    xyz: np.ndarray,
    form: int = 0,
    version: tuple[int, int] = (1, 2),
    colour: np.ndarray | None = None,
    kind: np.ndarray | None = None,
    count: int | None = None,
    scale: float = 0.001,
    offset: tuple = (0.0, 0.0, 0.0),
    note: bytes = b"",
    packed: bool = False,
) -> bytes:
    """A LAS file of any version and point format. `note`: a variable length record; `packed`: say that records are packed."""
    length = 375 if version >= (1, 4) else 235 if version == (1, 3) else 227
    head = bytearray(length)
    head[:4], head[24:26] = b"LASF", bytes(version)
    number = len(xyz) if count is None else count
    begins = length + len(note)
    struct.pack_into("<HIIBHI", head, 94, length, begins, int(bool(note)), form | (128 if packed else 0), SIZES[form], number if form < 6 else 0)
    struct.pack_into("<6d", head, 131, scale, scale, scale, *offset)
    if version >= (1, 4):
        struct.pack_into("<Q", head, 247, number)
    return bytes(head) + note + records(xyz, form, colour, kind, scale, offset).tobytes()


def records(xyz, form, colour=None, kind=None, scale=0.001, offset=(0.0, 0.0, 0.0)) -> np.ndarray:
    """Point data records, as bytes."""
    rows = np.zeros((len(xyz), SIZES[form]), np.uint8)
    rows[:, :12] = np.round((xyz - np.array(offset)) / scale).astype("<i4").view(np.uint8)
    if kind is not None:
        rows[:, 16 if form >= 6 else 15] = kind
    if colour is not None:
        rows[:, COLOURS[form] : COLOURS[form] + 6] = np.ascontiguousarray(colour.astype("<u2")).view(np.uint8)
    return rows


def laz(xyz: np.ndarray, form: int = 0) -> bytes:
    """A LAZ file, packed by lazrs."""
    import lazrs

    how = lazrs.LazVlr.new_for_compression(form, 0)
    held = how.record_data()
    note = struct.pack("<H16sHH32s", 0, b"laszip encoded", 22204, len(held), b"") + held
    version = (1, 4) if form >= 6 else (1, 2)
    plain = las(xyz, form, version, note=note, packed=True)
    rows = records(xyz, form)
    out = io.BytesIO()
    out.write(plain[: len(plain) - rows.size])
    packer = lazrs.LasZipCompressor(out, how)
    packer.compress_many(rows.tobytes())
    packer.done()
    return out.getvalue()
