"""What do COLMAP's steps find in a folder of photos? Details, the same ones in two photos, cameras → a model on the disk, and what every two photos share.

Done in a process of its own (`apart`): COLMAP can't be asked to end.
"""

from collections.abc import Callable
from contextlib import closing
from pathlib import Path

import numpy as np
from jaxtyping import Float

Told = tuple[str, str, Float[np.ndarray, "detail 2"], Float[np.ndarray, "detail 2"]]
"""Two photos, and where each has the details that they share, in focal lengths from its middle, without the lens."""

TRIES = 3  # of the mapper, each from another seed, where it places under half of the photos


def placed(place: Path, groups: list[list[str]], details: int, seed: int, tell: Callable[[float], None]) -> list[Told] | None:
    """Writes the largest model of the photos in `place/photos` to `place/model`; those of a group share a camera. None: no photo could be placed."""
    import pycolmap

    pycolmap.logging.minloglevel = 3
    pycolmap.set_random_seed(seed)
    _matched(pycolmap, place, groups, details, tell)
    count = sum(len(names) for names in groups)
    model = _mapped(pycolmap, place, seed, count, tell)
    if model is None:
        return None
    model.write_binary(place / "model")
    return _shared(pycolmap, place / "points.db", model)


def _matched(colmap, place: Path, groups: list[list[str]], details: int, tell) -> None:
    """Details of every photo, and which are the same in two."""
    extraction, reader = colmap.FeatureExtractionOptions(), colmap.ImageReaderOptions()
    extraction.use_gpu, reader.camera_model = False, "SIMPLE_RADIAL"
    extraction.sift.darkness_adaptivity, extraction.sift.max_num_features = True, details
    for k, names in enumerate(groups):
        colmap.extract_features(
            place / "points.db", place / "photos", names, camera_mode=colmap.CameraMode.SINGLE, reader_options=reader, extraction_options=extraction, device=colmap.Device.cpu
        )
        tell(0.25 * (k + 1) / len(groups))
    matching = colmap.FeatureMatchingOptions()
    matching.use_gpu = False
    colmap.match_exhaustive(place / "points.db", matching_options=matching, device=colmap.Device.cpu)
    tell(0.5)


def _mapped(colmap, place: Path, seed: int, count: int, tell):
    """The model that places the most photos."""
    found = [0]

    def one_more() -> None:
        found[0] += 1
        tell(0.5 + 0.5 * min(1.0, found[0] / count))

    options = colmap.IncrementalPipelineOptions()
    options.extract_colors = False
    (place / "model").mkdir()
    best, most = None, 0
    for again in range(TRIES):  # from two photos that turn out badly hardly any others are reached
        options.random_seed, found[0] = seed + again, 0
        (place / f"try {again}").mkdir()
        models = colmap.incremental_mapping(place / "points.db", place / "photos", place / f"try {again}", options=options, next_image_callback=one_more)
        for model in models.values():
            if model.num_reg_images() > most:
                best, most = model, model.num_reg_images()
        if most >= count / 2:
            break
    return best


def _shared(colmap, database: Path, model) -> list[Told]:
    """What every two photos of the model share that COLMAP has verified by the two alone."""
    shared = []
    with closing(colmap.Database.open(database)) as told:
        photos = {number: model.images[number] for number in model.reg_image_ids()}
        xy = {number: model.cameras[photo.camera_id].cam_from_img(told.read_keypoints(number)[:, :2].astype(np.float64)) for number, photo in photos.items()}
        for number, geometry in zip(*told.read_two_view_geometries(), strict=True):
            one, other = colmap.pair_id_to_image_pair(number)
            if one in xy and other in xy and len(geometry.inlier_matches):
                first, second = geometry.inlier_matches.T
                shared.append((photos[one].name, photos[other].name, xy[one][first], xy[other][second]))
    return shared
