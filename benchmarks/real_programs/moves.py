"""Does a growing tree move in Blender and three.js as it does here? `python -m benchmarks.real_programs.moves FILE... [--pictures DIR]`

Where all vertices are at five moments, as our own reader has them, beside where the programs have them: three.js for glTF, Blender for USD too. The
variables are those of `blender_opens` and `three_opens`. Prints a line a file and program; exit status 1 where a vertex is farther off than 1/4000 of the
tree's height (USD keeps scales in half precision), or three.js has something to say.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from benchmarks.real_programs import blender_opens, three_opens
from sketchtree.animation.posing import posed
from sketchtree.asset import Asset
from sketchtree.export.read import read_contents

MOMENTS = (0.0, 0.2, 0.5, 0.8, 1.0)  # shares of the whole
NEAR = 1 / 4000  # of the tree's height
BLENDER, THREE = Path(__file__).with_name("blender_moves_side.py"), Path(__file__).with_name("three_moves_side.cjs")


def seconds_of(asset: Asset) -> list[float]:
    """The moments, in seconds."""
    return [share * asset.animation.seconds for share in MOMENTS]


def in_blender(path: Path, asset: Asset, picture: Path | None = None) -> dict:
    """What Blender says of the file, `off`: how far each vertex is from ours, metres."""
    program = os.environ[blender_opens.VARIABLE]
    begin = [program, "-b", "-P", str(BLENDER), "--"] if Path(program).name.startswith("blender") else [program, str(BLENDER)]
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "seen.npz"
        told = [str(path), ",".join(map(str, seconds_of(asset))), str(out), *([str(picture)] if picture else [])]
        done = subprocess.run([*begin, *told], capture_output=True, text=True, check=False, timeout=1200)
        found = [line for line in done.stdout.splitlines() if line.startswith("SEEN ")]
        if not found:
            raise RuntimeError(f"Blender could not play {path}: {(done.stderr or done.stdout).strip()[-2000:]}")
        with np.load(out) as kept:
            places = dict(kept)
    used = {part.name: np.unique(part.triangle) for part in asset.parts}  # Blender leaves out vertices that no triangle has
    off = [_off(places.get(f"{k}/{mesh.name}"), mesh, used[mesh.name]) for k, second in enumerate(seconds_of(asset)) for mesh in posed(asset, second)]
    return json.loads(found[-1][5:]) | {"off": np.concatenate(off), "said": []}


def in_three(path: Path, asset: Asset, pictures: Path | None = None) -> dict:
    """What three.js says of the file, `off`: how far vertices are from ours, metres."""
    told = [",".join(map(str, seconds_of(asset))), f"{path}={pictures}" if pictures else str(path)]
    done = subprocess.run(["node", str(THREE), os.environ[three_opens.VARIABLE], three_opens.chromium() or "", *told], capture_output=True, text=True, check=False, timeout=1200)
    found = [json.loads(line[5:]) for line in done.stdout.splitlines() if line.startswith("SEEN ")]
    if not found or "error" in found[0]:
        raise RuntimeError(f"three.js could not play {path}: {found[0]['error'] if found else done.stderr.strip()[-2000:]}")
    off = []
    for second, meshes in zip(seconds_of(asset), found[0]["moments"], strict=True):
        seen = {mesh["name"]: mesh for mesh in meshes}
        for mesh in posed(asset, min(second, asset.animation.seconds - 1e-6)):
            off.append(np.linalg.norm(np.reshape(seen[mesh.name]["places"], (-1, 3)) - mesh.position[:: seen[mesh.name]["step"]], axis=1))
    return found[0] | {"off": np.concatenate(off)}


def _off(places, mesh, used):
    if places is None or len(places) not in (len(mesh.position), len(used)):
        return np.array([np.inf])
    return np.linalg.norm(places - (mesh.position if len(places) == len(mesh.position) else mesh.position[used]), axis=1)


def differences(seen: dict, asset: Asset) -> list[str]:
    """What of it is wrong, one line each."""
    height = max(float(np.ptp(np.concatenate([part.position[:, 1] for part in asset.parts]))), 1e-9)
    wrong = [f"a vertex is {1000 * seen['off'].max():.2f} mm off"] if not seen["off"].max() <= NEAR * height else []
    return wrong + seen["said"]


def main(arguments: list[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.real_programs.moves")
    parser.add_argument("files", nargs="+", type=Path)
    parser.add_argument("--pictures", type=Path, metavar="DIR")
    chosen = parser.parse_args(arguments)
    failed, ran = 0, 0
    for path in chosen.files:
        asset = read_contents(path).asset
        if asset.animation is None:
            parser.error(f"{path} does not move")
        for program, look in (("three", in_three), ("blender", in_blender)):
            if (program == "three" and (path.suffix.lower() not in (".glb", ".gltf") or three_opens.missing())) or (program == "blender" and blender_opens.missing()):
                continue
            picture = None if chosen.pictures is None else chosen.pictures if program == "three" else chosen.pictures / f"{path.stem}_{path.suffix[1:]}_blender.png"
            seen = look(path, asset, picture)
            wrong, ran = differences(seen, asset), ran + 1
            failed += bool(wrong)
            cost = f"{seen['update']:.1f} ms a frame before it is drawn" if program == "three" else f"import {seen['import']:.1f} s, {1000 * seen['frame']:.0f} ms a frame"
            told = f"{seen['program']}, {seen['bones']} bones, {cost}; off {1000 * np.median(seen['off']):.3f} mm (median), {1000 * seen['off'].max():.2f} mm (most)"
            print(f"{path.name}: {told}: {'; '.join(wrong) or 'as we see it'}", flush=True)
    if not ran:
        print("; ".join(filter(None, (three_opens.missing(), blender_opens.missing()))) or "nothing to run")
        return 2
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
