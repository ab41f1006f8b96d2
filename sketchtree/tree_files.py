"""Which files does one tree become?

    plain             TREE.glb
    --levels apart    TREE_LOD0.glb … TREE_LOD3.glb, TREE_impostor.glb
    --pack game       TREE.glb, TREE_LOD1.glb …, TREE_impostor.glb, TREE_collision.glb, pivots' textures, skeleton, manifest

Beside them `.gltf` has its `.bin`, `.obj` its `.mtl`. Textures are named after materials, which are known only when the tree is: `write_asset` minds
those. An impostor is there only where there is something to see.
"""

from dataclasses import dataclass
from pathlib import Path

from sketchtree.options import FileOptions

_BESIDE = {".gltf": ".bin", ".obj": ".mtl"}


@dataclass(frozen=True)
class TreeFiles:
    """The files of one tree, each by its path."""

    sure: tuple[Path, ...]  # written in any case, the first of them what a person opens
    perhaps: tuple[Path, ...] = ()

    @property
    def all(self) -> tuple[Path, ...]:
        """Those that may be written."""
        return self.sure + self.perhaps


def tree_files(output: Path, files: FileOptions = FileOptions()) -> TreeFiles:
    """The files of a tree that is written as `output` with these options."""
    if files.levels != "apart" and not files.pack:
        return TreeFiles(_with_others((output,)))
    from sketchtree.levels.make import SHARES

    count = len(SHARES) + 1
    if files.pack:
        from sketchtree.rig.pack import pack_roles

        roles = pack_roles(output.stem, count, True)
        far = [name for name, role in roles.items() if role == "impostor"]
        return TreeFiles(tuple(output.with_name(name) for name in roles if name not in far), tuple(map(output.with_name, far)))
    from sketchtree.export.write import impostor_path, level_path

    return TreeFiles(_with_others(tuple(level_path(output, number) for number in range(count))), _with_others((impostor_path(output),)))


def _with_others(paths: tuple[Path, ...]) -> tuple[Path, ...]:
    """The paths, and the file that stands beside each of them by its format."""
    beside = _BESIDE.get(paths[0].suffix.lower())
    return paths + (tuple(path.with_suffix(beside) for path in paths) if beside else ())
