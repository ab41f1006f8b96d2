"""Which program wrote these poses? Told by what is there: a COLMAP model, a transforms.json, a bundle.out → Poses."""

import os
from pathlib import Path, PurePath

from sketchtree.errors import ViewsError
from sketchtree.multiview.photos import photo_files, photo_size
from sketchtree.multiview.poses.bundler import read_bundler
from sketchtree.multiview.poses.colmap import read_colmap
from sketchtree.multiview.poses.posed import Poses
from sketchtree.multiview.poses.transforms import read_transforms


def read_poses(path: str | os.PathLike, photos: str | os.PathLike) -> Poses:
    """Where the photos in that folder were taken from. Raises ViewsError for a file of another kind, and for fewer than two photos."""
    path, files = Path(path), photo_files(photos)

    def sized(name: str) -> tuple[str, tuple[int, int]]:
        file = find_photo(name, files)
        return file.name, photo_size(file)

    if path.is_dir():
        poses = read_colmap(_model(path))
    elif not path.exists():
        raise ViewsError(f"There are no poses at {path}.", remedy="Give a COLMAP folder, a transforms.json or a bundle.out.")
    elif path.suffix == ".json":
        poses = read_transforms(path, sized)
    elif path.suffix == ".out":
        poses = read_bundler(path, sized, [file.name for file in files])
    else:
        raise ViewsError(f"{path.name} is no file of poses.", remedy="Give a COLMAP folder, a transforms.json or a bundle.out.")
    if len(poses) < 2:
        raise ViewsError(f"{path.name} places {len(poses)} photo(s).", remedy="Depth needs two at least; give poses for more of them.")
    return poses


def find_photo(name: str, files: list[Path]) -> Path:
    """The file of a photo that poses name, with or without folder and extension."""
    wanted = PurePath(name.replace("\\", "/"))
    for same in (lambda file: file.name == wanted.name, lambda file: file.stem == wanted.name, lambda file: file.stem == wanted.stem):
        hits = [file for file in files if same(file)]
        if hits:
            return hits[0]
    raise ViewsError("it is named by the poses, but is not in the folder.", photo=name, remedy="Put it there, or leave its pose out.")


def _model(folder: Path) -> Path:
    """Where in a COLMAP folder the model is."""
    for place in (folder, folder / "sparse" / "0", folder / "sparse", folder / "0"):
        if any((place / f"cameras{kind}").exists() for kind in (".bin", ".txt")):
            return place
    raise ViewsError(f"{folder} holds no COLMAP model.", remedy="Give the folder with cameras, images and points3D (.txt or .bin).")
