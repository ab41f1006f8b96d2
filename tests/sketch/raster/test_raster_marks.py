"""Marks that are no wood: specks, hatching, scribbles of leaves, dots. Left out or understood, and always reported."""

import numpy as np
import pytest
import shapely
import sheets
from PIL import Image, ImageDraw

from sketchtree.sketch.reading import sketch_graph
from sketchtree.sketch.strokes import StrokeKind

BIG = (600, 720)
TREE = [2 * line for line in sheets.TREE]
RNG = np.random.default_rng(11)


def specks(count: int, radius: float = 1.0) -> np.ndarray:
    """Dust all over the page, away from the tree."""
    wood = shapely.union_all([shapely.LineString(line) for line in TREE])
    places = RNG.uniform((10, 10), (590, 710), (4 * count, 2))
    clear = places[shapely.distance(wood, shapely.points(places)) > 12][:count]
    return sheets.cover([np.array([p, p + 0.1]) for p in clear], 2 * radius, BIG)


def test_specks_are_left_out_and_counted():
    sketch = sheets.read(np.maximum(sheets.cover(TREE, 5, BIG), specks(60)))
    assert len(sketch) == 4 and sheets.apart(sketch, TREE) < 3.0
    (warning,) = sketch.warnings
    assert warning.endswith("specks were left out as dust or grain of the paper.") and 50 <= int(warning.split()[0]) <= 60


def test_hatching_is_left_out_and_counted():
    hatching = [np.array([(380 + 8 * k, 560), (410 + 8 * k, 520)]) for k in range(14)]
    sketch = sheets.read(sheets.cover([*TREE, *hatching], 4, BIG))
    assert len(sketch) == 4 and sheets.apart(sketch, TREE) < 3.0
    assert sketch.warnings == ("14 short parallel lines were taken for hatching and left out.",)


def test_short_parallel_twigs_on_a_limb_are_no_hatching():
    limb = np.array([(100, 400), (500, 380)])
    twigs = [np.array([(130 + 30 * k, 398 - 1.5 * k), (150 + 30 * k, 350 - 1.5 * k)]) for k in range(11)]
    trunk = np.array([(300, 700), (300, 390)])
    sketch = sheets.read(sheets.cover([trunk, limb, *twigs], 4, BIG))
    assert len(sketch) >= 13 and not sketch.warnings


def scribble(centre, size: float, seed: int) -> np.ndarray:
    """A pen that goes round and round as it wanders, as people fill a crown."""
    t = np.linspace(0, 16 * np.pi, 500)
    rng = np.random.default_rng(seed)
    drift = np.stack([np.sin(t / 9 + rng.uniform(0, 6)), np.cos(t / 7 + rng.uniform(0, 6))], 1) * size * 0.7
    return np.asarray(centre) + drift + 0.28 * size * np.stack([np.cos(t), np.sin(t)], 1)


def test_scribbled_leaves_are_a_crown_and_no_branches():
    limbs = [*TREE]
    tips = [line[-1] for line in TREE]
    leaves = [scribble(tip + shift, 45, 7 * k + j) for k, tip in enumerate(tips) for j, shift in enumerate([(0, 0), (45, 25), (-40, 30)])]
    sketch = sheets.read(sheets.cover([*limbs, *leaves], 4, BIG))
    wood = [s for s in sketch.strokes if s.kind == StrokeKind.BRANCH]
    assert len(wood) <= 24  # of some 170 pieces
    assert any("taken for foliage" in warning for warning in sketch.warnings)
    below = [np.array([p for p in line if p[1] > 300]) for line in TREE[:1]]
    assert sheets.farthest(below, sheets.curves(sketch)) < 4


def test_limbs_that_bend_are_not_taken_for_leaves():
    t = np.linspace(0, 1, 60)
    limbs = [np.stack([300 + 230 * side * t, y - 120 * t + 25 * np.sin(9 * t)], 1) for y in (300, 380, 460, 540) for side in (-1, 1)]
    sketch = sheets.read(sheets.cover([np.array([(300, 700), (300, 60)]), *limbs], 4, BIG))
    assert {s.kind for s in sketch.strokes} == {StrokeKind.BRANCH} and len(sketch) in range(5, 12) and not sketch.warnings


def dotted(radius=(240, 190), centre=(300, 250), every=12.0, dot=3.2, part=1.0):
    """A row of dots round the crown."""
    turn = np.linspace(0, 2 * np.pi * part, int(part * 1350 / every), endpoint=False) + np.pi / 2
    places = np.asarray(centre) + np.asarray(radius) * np.stack([np.cos(turn), np.sin(turn)], 1)
    return places, sheets.cover([np.array([p, p + 0.1]) for p in places], 2 * dot, BIG)


def test_a_dotted_outline_is_a_crown():
    places, dots = dotted()
    ink = np.maximum(sheets.cover([line * (0.8, 0.8) + (60, 130) for line in TREE], 5, BIG), dots)
    sketch = sheets.read(ink)
    (crown,) = [s for s in sketch.strokes if s.kind == StrokeKind.CROWN]
    assert crown.closed
    ring = shapely.LinearRing(places)
    off = shapely.distance(shapely.points(crown.points * (1, -1)), ring)
    assert np.quantile(off, 0.9) < 1.5 and off.max() < 10  # limbs hide some of its dots
    assert shapely.distance(shapely.points(places), shapely.LinearRing(crown.points * (1, -1))).max() < 6
    graph = sketch_graph(sketch)
    assert len(graph.crown) == 1 and len(graph.limb_id) == 4


def test_a_row_of_dots_that_goes_round_nothing_is_no_crown():
    _, dots = dotted(part=0.2)
    sketch = sheets.read(np.maximum(sheets.cover(TREE, 5, BIG), dots))
    assert not [s for s in sketch.strokes if s.kind == StrokeKind.CROWN]


def test_painted_foliage_is_a_crown_and_its_shadow_is_left_out():
    image = Image.new("RGB", (600, 720), "white")
    brush = ImageDraw.Draw(image)
    brush.ellipse([180, 640, 460, 700], fill=(180, 180, 180))
    brush.polygon([(280, 670), (320, 670), (310, 300), (290, 300)], fill=(120, 75, 40))
    brush.ellipse([120, 60, 480, 400], fill=(60, 150, 60))
    sketch = sheets.read(image)
    (crown,) = [s for s in sketch.strokes if s.kind == StrokeKind.CROWN]
    assert shapely.Polygon(crown.points).area == pytest.approx(np.pi * 180 * 170, rel=0.1)
    assert "A grey area under the tree was taken for its shadow and left out." in sketch.warnings
    (trunk,) = [s for s in sketch.strokes if s.kind == StrokeKind.BRANCH]
    assert np.abs(trunk.points[:, 0] - 300).max() < 8 and trunk.wood


def test_a_dashed_line_is_one():
    dashes = [np.array([(300, 690 - 24 * k), (300, 676 - 24 * k)]) for k in range(24)]
    sketch = sheets.read(sheets.cover([*dashes, np.array([(300, 500), (480, 380)])], 4, BIG))
    assert len(sketch) <= 3
