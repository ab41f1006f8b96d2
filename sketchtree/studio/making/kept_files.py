"""A tree that is no drawing's, as the files that a person asked for, by name."""

import tempfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from sketchtree.export.files import MESHES, SKELETONS, check_extension, check_program
from sketchtree.growth_tree import Worn
from sketchtree.options import FileOptions, TreeOptions
from sketchtree.tree_output import Made, check_files, write_output
from sketchtree.watch import Watch


def files_of(make: Callable[[TreeOptions], Worn], tree: TreeOptions, seed: int, name: str, options: dict, watch: Watch) -> dict[str, bytes]:
    """The files that it becomes: those that `sketchtree build` writes of the project. `make` is told how its wood is to be. Raises SketchTreeError."""
    wanted = replace(tree, **{key: options[key] for key in ("wood", "solid") if options.get(key)})
    files = FileOptions(**{key: value for key, value in options.items() if key not in ("wood", "solid")})
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / name
        check_extension(path, MESHES + SKELETONS)
        check_program(path)
        check_files(path, files, instead="Choose .glb.")
        worn = make(wanted)
        with watch("export"):
            watch.on_part(0.0)
            write_output(worn, path, Made(seed), files)
        return {str(one.relative_to(folder)): one.read_bytes() for one in sorted(Path(folder).rglob("*")) if one.is_file()}
