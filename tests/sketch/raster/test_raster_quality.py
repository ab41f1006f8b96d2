"""How well whole drawings are read from pictures of them. A bound that fails says which figure fell, and from what.

The bounds are what was measured, with a margin; `python -m benchmarks.raster_quality` measures all drawings in all media.
"""

from pathlib import Path

import pytest

from benchmarks.pictures import MEDIA, drawn, likeness, on_medium
from benchmarks.raster_quality import EXAMPLES, compare
from benchmarks.reading_speed import drawing
from sketchtree.sketch.files.svg import read_svg
from sketchtree.sketch.formats import read_sketch
from sketchtree.sketch.raster.reader import read_raster
from sketchtree.sketch.reading import sketch_graph
from sketchtree.sketch.strokes import StrokeKind

MEDIUM = {medium.name: medium for medium in MEDIA}
SHARED = Path(__file__).resolve().parents[4] / "shared" / "data" / "sketches"
#                       found  extra  whole  pure  ways
LEAST = {
    ("oak", "scan"): (0.995, 0.005, 0.88, 0.86, 0.90),
    ("oak", "pencil"): (0.995, 0.005, 0.87, 0.85, 0.85),
    ("spruce", "scan"): (0.995, 0.005, 0.93, 0.94, 0.95),
    ("spruce", "pencil"): (0.995, 0.005, 0.92, 0.93, 0.95),
    ("palm", "phone"): (0.995, 0.005, 0.90, 0.95, 0.90),
}


@pytest.mark.parametrize(("name", "medium"), LEAST)
def test_drawings_are_read_from_pictures_as_well_as_before(name, medium):
    like = compare(EXAMPLES / f"{name}.svg", MEDIUM[medium], 800, 3.0)
    found, extra, whole, pure, ways = LEAST[name, medium]
    assert like.found >= found and like.extra <= extra, like
    assert like.whole >= whole and like.pure >= pure, like
    assert like.ways >= ways and like.crowns[0] == like.crowns[1], like


def test_a_dense_tree_of_twigs_is_no_foliage():
    sketch = read_svg(drawing(200), "drawing.svg")
    cover, scale, corner = drawn(sketch, 1000, 2.0)
    read = read_raster(on_medium(cover, MEDIUM["scan"]), "twigs.jpg")
    like = likeness((sketch, read), (sketch_graph(sketch), sketch_graph(read)), scale, corner)
    assert like.found >= 0.98 and like.extra <= 0.02 and like.whole >= 0.75 and like.pure >= 0.85, like
    assert not any("foliage" in warning for warning in read.warnings)


@pytest.mark.skipif(not SHARED.exists(), reason="the folder of shared drawings is not beside this checkout")
class TestRuskin:
    """Pen drawings from John Ruskin's books."""

    def graph(self, name):
        return sketch_graph(read_sketch(SHARED / "ruskin" / f"{name}.png"))

    def test_the_tree_under_a_dotted_crown_has_limbs_and_a_crown(self):
        graph = self.graph("tree_dotted_crown")
        assert len(graph.crown) == 1 and 10 <= len(graph.limb_id) <= 16

    def test_the_crooked_tree_has_its_four_curled_limbs(self):
        assert 5 <= len(self.graph("crooked_tree_a").limb_id) <= 8

    def test_the_bough_has_its_limbs(self):
        assert 4 <= len(self.graph("bough_a").limb_id) <= 7

    def test_the_branch_keeps_its_limbs_among_the_leaves(self):
        sketch = read_sketch(SHARED / "ruskin" / "branch_leaves.png")
        long = [s for s in sketch.strokes if s.kind == StrokeKind.BRANCH and s.points[:, 0].max() - s.points[:, 0].min() > 60]
        assert len(long) >= 4
