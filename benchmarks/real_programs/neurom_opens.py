"""Does NeuroM read our SWC files? `python -m benchmarks.real_programs.neurom_opens FILE.swc...`

The variable SKETCHTREE_NEUROM_PYTHON names a Python that has `neurom` (from PyPI, in an environment of its own). NeuroM knows neurites, not trees: types
0, 5 and 6 are put to 3 (a dendrite) in a copy, and the first point of the root is its soma. Compared are the number of points and the length.
"""

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from benchmarks.real_programs.ours import compared
from sketchtree.skeleton_files import read_swc

VARIABLE = "SKETCHTREE_NEUROM_PYTHON"
SCRIPT = """
import json, sys, warnings
warnings.simplefilter("ignore")
import neurom
import neurom.features as features
cell = neurom.load_morphology(sys.argv[1])
length = sum(float(value) for value in features.get("section_lengths", cell))
forks = int(features.get("number_of_bifurcations", cell))
print("SEEN " + json.dumps({"points": len(cell.points), "length": length, "forks": forks, "version": neurom.__version__}))
"""


def as_neuron(path: Path) -> str:
    """The file with the types that a neuron has."""
    lines = []
    for line in path.read_text().splitlines():
        words = line.split()
        lines.append(line if line.startswith("#") else " ".join([words[0], "1" if words[6] == "-1" else "3", *words[2:]]))
    return "\n".join(lines) + "\n"


def seen_by_neurom(path: Path) -> dict:
    """Points, length and forks that NeuroM finds. Raises RuntimeError with its own words where it can't read the file."""
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / path.name
        copy.write_text(as_neuron(path))
        done = subprocess.run([os.environ[VARIABLE], "-c", SCRIPT, str(copy)], capture_output=True, text=True, check=False, timeout=300)
    found = [line for line in done.stdout.splitlines() if line.startswith("SEEN ")]
    if not found:
        raise RuntimeError(f"NeuroM could not read {path}: {done.stderr.strip()[-1500:]}")
    return json.loads(found[-1][5:])


def differences(seen: dict, path: Path) -> list[str]:
    """What NeuroM saw otherwise than we do. The soma is a point of its own; a limb that starts on it has no length up to it; forks are those of two."""
    tree = read_swc(path)
    length = float(tree.length[tree.parent > 0].sum())
    said = [] if abs(seen["length"] - length) < 1e-3 * length else [f"length {seen['length']:.3f}, not {length:.3f}"]
    forks = int(np.sum(np.bincount(tree.parent[tree.parent > 0], minlength=len(tree)) == 2))
    return said + ([f"{seen['forks']} forks, not {forks}"] if seen["forks"] != forks else [])


def missing() -> str | None:
    """Why it can't be run here; None if it can."""
    return None if os.environ.get(VARIABLE) else f"{VARIABLE} does not name a Python that has `neurom`"


def main(paths: list[str]) -> int:
    def told(seen: dict) -> str:
        return f"NeuroM {seen['version']}, {seen['points']} points, {seen['forks']} forks, {seen['length']:.1f} m"

    return compared(paths, missing(), seen_by_neurom, differences, told)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
