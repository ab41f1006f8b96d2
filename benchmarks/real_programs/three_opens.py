"""Does three.js see what we wrote? `python -m benchmarks.real_programs.three_opens FILE... [--pictures DIR]`

It loads each glTF file in a headless Chromium (software rendering), counts what its scene holds, instances too, and takes a picture. The variable
SKETCHTREE_THREE names a folder whose `node_modules` has `three` and `puppeteer-core`; Node and Chromium must be there. Exit status 1
where it sees another number of triangles, other materials or bounds, or says a warning.
"""

import argparse
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

from benchmarks.real_programs.ours import differences

SCRIPT = Path(__file__).with_name("three_side.cjs")
VARIABLE = "SKETCHTREE_THREE"


def chromium() -> str | None:
    """The browser's program, if there is one."""
    return next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)


def missing() -> str | None:
    """Why it can't be run here; None if it can."""
    if not os.environ.get(VARIABLE):
        return f"{VARIABLE} does not name a folder whose node_modules has `three` and `puppeteer-core`"
    return None if shutil.which("node") and chromium() else "Node or Chromium is not installed"


def seen_by_three(paths: list[Path], pictures: Path | None = None) -> list[dict]:
    """What three.js has in its scene after loading each file. Raises RuntimeError where the browser does not run."""
    wanted = [f"{path}={pictures / (path.stem + '.png')}" if pictures else str(path) for path in paths]
    done = subprocess.run(["node", str(SCRIPT), os.environ[VARIABLE], chromium() or "", *wanted], capture_output=True, text=True, check=False, timeout=600)
    seen = [json.loads(line[5:]) for line in done.stdout.splitlines() if line.startswith("SEEN ")]
    if len(seen) < len(paths):
        raise RuntimeError(f"three.js did not run: {done.stderr.strip()[-2000:]}")
    return seen


def main(arguments: list[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.real_programs.three_opens")
    parser.add_argument("files", nargs="+", type=Path)
    parser.add_argument("--pictures", type=Path, metavar="DIR")
    chosen = parser.parse_args(arguments)
    if why := missing():
        parser.error(why)
    failed = 0
    for path, seen in zip(chosen.files, seen_by_three(chosen.files, chosen.pictures), strict=True):
        wrong = [seen["error"]] if "error" in seen else differences(seen, path) + seen["said"]
        failed += bool(wrong)
        found = f"{seen.get('triangles')} triangles in {seen.get('draws')} draws, {seen.get('bones')} bones"
        print(f"{path.name}: {seen.get('program')}, {found}: {'; '.join(wrong) or 'as we see it'}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
