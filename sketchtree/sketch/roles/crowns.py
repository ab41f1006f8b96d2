"""Which strokes draw the crowns? One rule after the other, until one finds an outline; then what the scribbles are.

A name wins. Then: closed outlines, trees painted in one piece, one contour on its trunk, several arcs, an outline alone.
"""

import dataclasses

import numpy as np
import shapely
from jaxtyping import Bool

from sketchtree.sketch.roles.arcs import crown_of_arcs
from sketchtree.sketch.roles.contour import contour, lone_outline
from sketchtree.sketch.roles.crown import closed_crowns, on_ground, outline
from sketchtree.sketch.roles.found import Found
from sketchtree.sketch.roles.masses import border, bulk_and_trunk
from sketchtree.sketch.roles.measures import Measures
from sketchtree.sketch.roles.scribble import Scribble, meaning, scribbles
from sketchtree.sketch.roles.stubs import stubs
from sketchtree.sketch.roles.table import Table
from sketchtree.sketch.strokes import Stroke

PAINTED = 0.5  # of the drawing's size: a crown and trunk painted in one piece are larger


def _find_painted_trees(table: Table) -> None:
    """Crowns painted in one with their trunk."""
    m = table.m
    size = float((m.drawing[1] - m.drawing[0]).max())
    large = table.free & m.filled & (m.size >= PAINTED * size) & (m.area >= 0.05 * m.size**2)
    for row in np.flatnonzero(large).tolist():
        area = shapely.make_valid(shapely.Polygon(m.strokes[row].points))
        crown, trunk = bulk_and_trunk(area) if area.geom_type == "Polygon" else (None, [])
        if crown is not None:
            table.outlines.append(border(crown))
            table.take([Found(row, "crown", "the bulky part of a tree painted in one piece")])
            table.pieces += [(row, dataclasses.replace(m.strokes[row], points=border(piece))) for piece in trunk]


def find_crowns(table: Table, ground: list[np.ndarray]) -> None:
    """The crowns by their shape, unless the file names one; and what the scribbles are."""
    m = table.m
    wild = scribbles(m, table.free)
    tame = table.wood.copy()
    tame[wild] = False
    if not table.outlines:
        closed = closed_crowns(m, table.free & tame, tame, ground)
        table.take(closed)
        tame[[one.row for one in closed]] = False
        table.outlines += [outline(m.strokes[one.row].points) for one in closed if one.role == "crown"]
    if not table.outlines:
        _find_painted_trees(table)
        tame &= table.wood
    if not table.outlines:
        _find_contour(table, np.flatnonzero(tame))
    if not table.outlines:
        _find_arcs(table, tame)
    if not table.outlines and (alone := lone_outline(_closed_by(ground, m, np.flatnonzero(tame)))) is not None:
        table.outlines.append(outline(alone))
        table.take([Found(int(row), "crown", "a closed outline without a trunk") for row in np.flatnonzero(tame)])
    find_stubs(table)
    for row in wild.tolist():
        _take_scribble(table, meaning(m, row, table.crown_area(), alone=not table.outlines and len(wild) == table.wood.sum()))


def find_stubs(table: Table) -> None:
    """Trunks drawn as stout shapes under a crown."""
    rows = np.flatnonzero(table.free)
    if not table.outlines or len(rows) == 0:
        return
    for stub in stubs(table.m, rows, table.outlines):
        table.stubs.append((stub.row, stub.middle, stub.width))
        table.take(list(stub.inner))
        table.wood[stub.row] = table.free[stub.row] = False


def _closed_by(ground: list[np.ndarray], m: Measures, rows) -> list[Stroke]:
    """These strokes, those with both ends on a ground line closed."""
    standing = on_ground(m, ground)
    return [dataclasses.replace(m.strokes[row], closed=True) if standing[row] else m.strokes[row] for row in rows]


def _find_contour(table: Table, rows) -> None:
    """A crown that is one contour on its trunk."""
    around = contour([table.m.strokes[row] for row in rows])
    if around is None:
        return
    table.outlines.append(outline(around.outline))
    for k, legs in around.legs.items():
        row = int(rows[k])
        table.take([Found(row, "crown", "part of one contour around a crown on its trunk")])
        if legs:
            table.legs[row] = legs


def _find_arcs(table: Table, tame: Bool[np.ndarray, " stroke"]) -> None:
    """A crown that several arcs draw."""
    arcs = crown_of_arcs(table.m, table.free & tame, tame)
    if arcs is not None:
        table.outlines.append(outline(arcs.outline))
        table.take([Found(int(row), "crown", "one of several arcs around the branches", (("branch", 0.5),)) for row in arcs.rows])


def _take_scribble(table: Table, scribble: Scribble) -> None:
    if scribble.role == "crown":
        table.outlines.append(scribble.outline)
        table.take([Found(scribble.row, "crown", "a scribble of foliage")])
    elif scribble.role == "leaves":
        table.take([Found(scribble.row, "leaves", "a scribble of foliage", (("branch", 0.6),))])
    if scribble.middle:
        table.legs[scribble.row] = scribble.middle
        table.wood[scribble.row] = table.free[scribble.row] = False
