"""What should a program see in this file? As our own reader reads it."""

from pathlib import Path

import numpy as np

from sketchtree.export.read import read_contents


def holds(path: Path) -> dict:
    """Triangles of the finest level, names of its materials, bounds in metres with y up."""
    parts = [part for part in read_contents(path).asset.parts if part.triangle_count]
    meshes = [part.merged() for part in parts]
    place = np.concatenate([mesh.position for mesh in meshes]) if meshes else np.zeros((1, 3))
    return {
        "triangles": sum(mesh.triangle_count for mesh in meshes),
        "materials": sorted({mesh.material.name for mesh in meshes}),
        "bounds": [place.min(axis=0).tolist(), place.max(axis=0).tolist()],
    }


def differences(seen: dict, path: Path) -> list[str]:
    """What a program saw otherwise than we do, one line each. Materials that differ by a number alone are tints of one."""
    ours = holds(path)
    said = [f"{seen['triangles']} triangles, not {ours['triangles']}"] if seen["triangles"] != ours["triangles"] else []
    names = sorted({name for name in ours["materials"] if any(_same(name, other) for other in seen["materials"])})
    strange = [other for other in seen["materials"] if not any(_same(name, other) for name in ours["materials"])]
    if (names != ours["materials"] or strange) and path.suffix.lower() not in (".ply", ".stl"):  # which hold none
        said.append(f"materials {seen['materials']}, not {ours['materials']}")
    size = np.linalg.norm(np.subtract(*ours["bounds"]))
    if np.abs(np.subtract(seen["bounds"], ours["bounds"])).max() > 1e-3 * max(size, 1e-9):
        said.append(f"bounds {np.round(seen['bounds'], 3).tolist()}, not {np.round(ours['bounds'], 3).tolist()}")
    return said


def compared(paths: list[str], missing: str | None, look, differing, told) -> int:
    """Look at every file with a program and print a line each; returns the exit status.

    `missing` says why the program can't be run here; `look(path)` what it sees, `differing(seen, path)` what of that is wrong, and `told(seen)` what to print."""
    if missing:
        print(missing)
        return 2
    failed = 0
    for path in map(Path, paths):
        seen = look(path)
        wrong = differing(seen, path)
        failed += bool(wrong)
        print(f"{path.name}: {told(seen)}: {'; '.join(wrong) or 'as we see it'}")
    return 1 if failed else 0


def _same(name: str, seen: str) -> bool:
    rest = seen.removeprefix(name)
    return rest != seen and rest.strip("._").isdecimal() or seen == name
