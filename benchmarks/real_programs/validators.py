"""Have the formats' own validators anything to say? `python -m benchmarks.real_programs.validators FILE...`

glTF by Khronos' validator (the npm package `gltf-validator`, found globally or in the folder that the variable GLTF_VALIDATOR names): errors and
warnings count, and its remark that it does not know an extension of ours does not. USD by every validator of `pxr.UsdValidation`. Prints a
line a file; exit status 1 where there is anything to say.
"""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

SCRIPT = """
const validator = require('gltf-validator'), fs = require('fs'), path = require('path');
(async () => {
  const found = [];
  for (const file of process.argv.slice(1)) {
    const beside = (uri) => Promise.resolve(new Uint8Array(fs.readFileSync(path.join(path.dirname(file), decodeURIComponent(uri)))));
    found.push((await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), { uri: path.basename(file), externalResourceFunction: beside })).issues);
  }
  console.log(JSON.stringify(found));
})();
"""


def gltf_validator() -> str | None:
    """Why the glTF validator can't be run here; None if it can."""
    if not shutil.which("node"):
        return "Node is not installed"
    if _node("require('gltf-validator')").returncode:
        return "the npm package gltf-validator is not installed (set GLTF_VALIDATOR to its folder)"
    return None


def gltf_issues(*paths: Path) -> list[dict]:
    """The validator's issues of each file: `numErrors`, `numWarnings`, `messages` …"""
    done = _node(SCRIPT, *map(str, paths))
    if done.returncode:
        raise RuntimeError(done.stderr)
    return json.loads(done.stdout)


def usd_issues(path: Path) -> list[str]:
    """What the validators of USD say of one file."""
    from pxr import Usd, UsdValidation

    stage = Usd.Stage.Open(str(path))
    context = UsdValidation.ValidationContext(UsdValidation.ValidationRegistry().GetOrLoadAllValidators())
    return [f"{error.GetName()}: {error.GetMessage()}" for error in context.Validate(stage)]


def _node(*arguments: str):
    places = [os.environ.get("GLTF_VALIDATOR", ""), os.environ.get("NODE_PATH", "")]
    if shutil.which("npm"):
        places.append(subprocess.run(["npm", "root", "-g"], capture_output=True, text=True, check=False).stdout.strip())
    places += [os.path.join(place, "node_modules") for place in places if place]
    return subprocess.run(["node", "-e", *arguments], capture_output=True, text=True, check=False, env=os.environ | {"NODE_PATH": os.pathsep.join(filter(None, places))})


def main(paths: list[str]) -> int:
    failed = 0
    if any(path.lower().endswith((".glb", ".gltf")) for path in paths) and (why := gltf_validator()):
        print(why)
        return 2
    for path in map(Path, paths):
        if path.suffix.lower() in (".glb", ".gltf"):
            (issues,) = gltf_issues(path)
            worst = [message for message in issues["messages"] if message["severity"] < 2]
            infos = sorted({message["code"] for message in issues["messages"] if message["severity"] >= 2})
            print(f"{path.name}: {issues['numErrors']} errors, {issues['numWarnings']} warnings; remarks: {', '.join(infos) or 'none'}")
        else:
            worst = usd_issues(path)
            print(f"{path.name}: {len(worst)} errors")
        for message in worst:
            print(f"    {message}")
        failed += bool(worst)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
