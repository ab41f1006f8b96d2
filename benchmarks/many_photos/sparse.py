"""What does structure from motion alone give? COLMAP's sparse points of the same photos: with the cameras that it finds, laid over the truth by them, and of the
true cameras, triangulated."""

import tempfile
from pathlib import Path

import numpy as np
from jaxtyping import Float

from benchmarks.many_photos.renders import Rendered
from sketchtree.errors import ViewsError
from sketchtree.multiview.sfm import structure_from_motion

_SIDE = 1600  # pixels, at most


def sparse_points(truth: Rendered, photos: Path) -> tuple[Float[np.ndarray, "point 3"], float, int, str]:
    """(points in the frame of the truth, mean distance of the cameras from the true ones as a share of their ring's radius, how many photos were placed, what was
    said); no points where COLMAP places too few or what it finds is refused."""
    try:
        found = structure_from_motion(photos, longest=_SIDE)
    except ViewsError as refused:
        return np.zeros((0, 3)), np.nan, 0, str(refused)
    poses, of = found.poses, {view.name: camera.centre for view, camera in zip(truth.views, truth.cameras, strict=True)}
    ours, true = np.array([photo.camera.centre for photo in poses.photos]), np.array([of[photo.name] for photo in poses.photos])
    scale, turn, shift = laid_over(ours, true)
    off = np.linalg.norm(scale * ours @ turn.T + shift - true, axis=1).mean() / np.linalg.norm(true - true.mean(axis=0), axis=1).mean()
    return scale * poses.points @ turn.T + shift, float(off), len(poses), f"{found.contradicted:.1%} of the pairs contradict"


def triangulated(truth: Rendered, photos: Path) -> Float[np.ndarray, "point 3"]:
    """COLMAP's points of the true cameras."""
    import pycolmap

    names = [view.name for view in truth.views]
    with tempfile.TemporaryDirectory(prefix="sketchtree-sparse-") as place:
        place = Path(place)
        extraction, matching, reader = pycolmap.FeatureExtractionOptions(), pycolmap.FeatureMatchingOptions(), pycolmap.ImageReaderOptions()
        extraction.use_gpu = matching.use_gpu = False
        reader.camera_model = "PINHOLE"
        options = {"camera_mode": pycolmap.CameraMode.SINGLE, "reader_options": reader, "extraction_options": extraction, "device": pycolmap.Device.cpu}
        pycolmap.extract_features(place / "points.db", photos, names, **options)
        pycolmap.match_exhaustive(place / "points.db", matching_options=matching, device=pycolmap.Device.cpu)
        (place / "model").mkdir()
        found = pycolmap.triangulate_points(_model(truth, place / "points.db"), place / "points.db", photos, place / "model")
        return np.array([point.xyz for point in found.points3D.values()]).reshape(-1, 3)


def _model(truth: Rendered, database: Path):
    """The true cameras as COLMAP keeps them."""
    import pycolmap

    found, first = pycolmap.Reconstruction(), truth.cameras[0]
    with pycolmap.Database.open(database) as told:
        images = {image.name: image for image in told.read_all_images()}
        number = next(iter(images.values())).camera_id
    focal = [first.matrix[0, 0], first.matrix[1, 1], *first.matrix[:2, 2]]
    found.add_camera_with_trivial_rig(pycolmap.Camera(model="PINHOLE", width=first.size[0], height=first.size[1], params=focal, camera_id=number))
    for view, camera in zip(truth.views, truth.cameras, strict=True):
        image = pycolmap.Image(name=view.name, camera_id=number, image_id=images[view.name].image_id)
        pose = np.column_stack([camera.rotation, -camera.rotation @ camera.centre])
        found.add_image_with_trivial_frame(image, pycolmap.Rigid3d(pose))
    return found


def laid_over(points: Float[np.ndarray, "point 3"], onto: Float[np.ndarray, "point 3"]) -> tuple[float, Float[np.ndarray, "3 3"], Float[np.ndarray, " 3"]]:
    """Scale, rotation and shift that bring points nearest to others (Umeyama 1991)."""
    a, b = points - points.mean(axis=0), onto - onto.mean(axis=0)
    u, size, v = np.linalg.svd(b.T @ a)
    sign = np.diag([1.0, 1.0, np.sign(np.linalg.det(u @ v))])
    turn = u @ sign @ v
    scale = float((size * np.diag(sign)).sum() / (a**2).sum())
    return scale, turn, onto.mean(axis=0) - scale * turn @ points.mean(axis=0)
