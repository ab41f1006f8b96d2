"""OBJ and its `.mtl` read back: objects, texture coordinates, normals, materials with their textures.

Corners are made vertices again: each combination v/vt/vn that an object uses is one. Polygons are cut into fans; a number below zero
counts from the end, as the format allows. Lines and free-form surfaces are passed over.
"""

from pathlib import Path

import numpy as np

from sketchtree.export.images import decode
from sketchtree.geometry.mesh import Material, Mesh


def read_obj(path: Path) -> list[Mesh]:
    """A mesh an object and material. Raises OSError, and ValueError or IndexError for what is no OBJ."""
    columns: dict[str, list] = {"v": [], "vt": [], "vn": []}
    groups: dict[tuple[str, str], list] = {}
    library, name, material = "", path.stem, ""
    with open(path, encoding="utf-8", errors="replace") as file:
        for line in file:
            word, _, rest = line.strip().partition(" ")
            if word in columns:
                columns[word].append(rest.split()[: 2 if word == "vt" else 3])
            elif word == "f":
                corners = [_corner(corner, columns) for corner in rest.split()]
                groups.setdefault((name, material), []).extend(corner for k in range(1, len(corners) - 1) for corner in (corners[0], corners[k], corners[k + 1]))
            elif word == "o":
                name = rest.strip()
            elif word == "usemtl":
                material = rest.strip()
            elif word == "mtllib":
                library = rest.strip()
    place, uv, normal = (np.array(columns[word] or np.zeros((0, width)), float) for word, width in (("v", 3), ("vt", 2), ("vn", 3)))
    materials = _library(path.parent / library) if library else {}
    return [_mesh(of, np.array(corners), place, uv, normal, materials.get(skin) or Material(skin or of)) for (of, skin), corners in groups.items()]


def _corner(text: str, columns: dict[str, list]) -> tuple[int, ...]:
    """(v, vt, vn) from 0; −1 where there is none."""
    numbers = [int(number) if number else 0 for number in text.split("/")] + [0, 0]
    return tuple(number - 1 if number >= 0 else len(columns[word]) + number for number, word in zip(numbers, columns, strict=False))


def _mesh(name: str, corner, place, uv, normal, material: Material) -> Mesh:
    used, triangle = np.unique(corner, axis=0, return_inverse=True)
    triangle = triangle.reshape(-1, 3)
    position = place[used[:, 0]]
    texture = uv[used[:, 1]] * [1.0, -1.0] + [0.0, 1.0] if len(uv) and (used[:, 1] >= 0).all() else np.zeros((len(used), 2))
    if len(normal) and (used[:, 2] >= 0).all():
        out = normal[used[:, 2]]
    else:
        a, b, c = (position[triangle[:, k]] for k in range(3))
        out = np.zeros_like(position)
        np.add.at(out, triangle.ravel(), np.repeat(np.cross(b - a, c - a), 3, axis=0))
    out = out / np.maximum(np.linalg.norm(out, axis=1, keepdims=True), 1e-12)
    return Mesh(name, position, out, texture, triangle, material)


def _library(path: Path) -> dict[str, Material]:
    """The materials by their names; none where the file is missing."""
    if not path.is_file():
        return {}
    said: dict[str, dict[str, str]] = {}
    for line in path.read_text(encoding="utf-8", errors="replace").splitlines():
        word, _, rest = line.strip().partition(" ")
        if word == "newmtl":
            said[rest] = {}
        elif said and word:
            said[next(reversed(said))][word] = rest.strip()
    return {name: _material(path.parent, name, words) for name, words in said.items()}


def _material(folder: Path, name: str, words: dict[str, str]) -> Material:
    picture = lambda word, mode: decode((folder / words[word]).read_bytes(), mode) if word in words and (folder / words[word]).is_file() else None  # noqa: E731
    masked = "map_d" in words
    red, green, blue = (float(word) for word in words.get("Kd", "1 1 1").split()[:3])
    return Material(
        name,
        base_color_texture=picture("map_Kd", "RGBA" if masked else "RGB"),
        normal_texture=picture("norm", "RGB"),
        roughness_texture=picture("map_Pr", "L"),
        base_color=(red, green, blue, float(words.get("d", 1.0))),
        roughness=float(words.get("Pr", 0.9)),
        alpha_cutoff=0.5 if masked else None,
        double_sided=masked,
    )
