"""Which files of tests take longest? They begin first, so that no process is still at one when the others are done (`conftest.py`).

By processor seconds of a whole run (`--durations=0` tells the tests): those of ten and more, the longest first.
"""

LONG = (
    "tests/studio/test_browser_studio.py",
    "tests/studio/test_browser_cloud.py",
    "tests/commands/test_batch.py",
    "notebooks/08_photos_and_point_clouds.ipynb",
    "tests/studio/test_browser_photo.py",
    "tests/studio/test_crew.py",
    "notebooks/07_growth.ipynb",
    "tests/studio/test_scribbled_files.py",
    "tests/photo/test_photo_tree.py",
    "notebooks/06_from_a_photo.ipynb",
    "tests/studio/test_browser_trunk.py",
    "tests/sketch/raster/test_raster_lines.py",
    "tests/studio/test_photo_growth.py",
    "tests/templates/test_match.py",
    "tests/commands/test_files_options.py",
    "tests/commands/test_photo_command.py",
    "tests/mrf/test_small_worlds.py",
    "tests/matting/test_mattes.py",
    "tests/studio/test_stocked.py",
    "tests/test_pipeline.py",
    "tests/templates/test_recipes.py",
    "tests/mrf/test_own.py",
    "tests/studio/test_page_sources.py",
    "notebooks/01_first_tree.ipynb",
    "tests/commands/test_grow_command.py",
    "tests/test_forest.py",
    "tests/commands/test_build.py",
    "tests/propagate/after/test_whole_way.py",
    "notebooks/03_your_own_prior_and_factor.ipynb",
    "tests/foliage/test_cards.py",
    "tests/sketch/raster/test_raster_foreign.py",
    "tests/benchmarks/test_calibration.py",
    "tests/foliage/test_painting.py",
)
_PLACE = {name: k for k, name in enumerate(LONG)}


def long_first(test) -> int:
    """By what tests are sorted."""
    return _PLACE.get(test.nodeid.split("::")[0], len(LONG))
