"""Does Blender see what we wrote? `python -m benchmarks.real_programs.blender_opens FILE...`

The variable SKETCHTREE_BLENDER_PYTHON names a Python that has `bpy` (5.0 or later, from PyPI, in an environment of its own) or a
`blender` program. Prints a line a file; exit status 1 where it sees another number of triangles, other materials or other bounds.
"""

import json
import os
import subprocess
import sys
from pathlib import Path

from benchmarks.real_programs.ours import compared, differences

SCRIPT = Path(__file__).with_name("blender_side.py")
VARIABLE = "SKETCHTREE_BLENDER_PYTHON"


def seen_by_blender(path: Path) -> dict:
    """What Blender has in its scene after importing the file. Raises RuntimeError with its own words where it can't."""
    program = os.environ[VARIABLE]
    call = [program, "-b", "-P", str(SCRIPT), "--", str(path)] if Path(program).name.startswith("blender") else [program, str(SCRIPT), str(path)]
    done = subprocess.run(call, capture_output=True, text=True, check=False, timeout=600)
    found = [line for line in done.stdout.splitlines() if line.startswith("SEEN ")]
    if not found:
        raise RuntimeError(f"Blender could not import {path}: {(done.stderr or done.stdout).strip()[-2000:]}")
    return json.loads(found[-1][5:])


def missing() -> str | None:
    """Why it can't be run here; None if it can."""
    return None if os.environ.get(VARIABLE) else f"{VARIABLE} does not name a Python that has `bpy`, or a `blender` program"


def main(paths: list[str]) -> int:
    def told(seen: dict) -> str:
        return f"{seen['program']}, {seen['triangles']} triangles, {len(seen['materials'])} materials, {seen['bones']} bones"

    return compared(paths, missing(), seen_by_blender, differences, told)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
