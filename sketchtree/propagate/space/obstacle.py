"""Where is one obstacle, and how near to it may wood come?

A mesh is known by the distance to its surface in space, a region drawn on the page by the distance to its outline in the plane: it
has no depth of its own, so it goes through the whole depth of the scene, and on the page nothing new shows within it.
What a surface encloses is solid; an open one is a sheet.

    margin m(p) = F(p) − c          how far p is from where wood may not be (F, ρ: `distance_field`)
    clearance c = max(`_KEEPS` · spacing of laterals, 2 ρ)

The free part of a step is found by strides of what the distance is at least, so that no sheet is too thin to be met; where a stride
ends too near, the step ends so much earlier on it.
"""

from dataclasses import dataclass

import numpy as np
import shapely
from jaxtyping import Float

from sketchtree.errors import OptionError
from sketchtree.propagate.space.distance_field import DistanceField, grid
from sketchtree.propagate.space.domain import Domain
from sketchtree.propagate.space.surface import APART, ENCLOSES, enclosed, line_samples, pieces, surface_samples, winding

_KEEPS = 0.2  # of the spacing of laterals
_FINE = 0.1  # of the spacing of laterals: how far apart samples are
_SAMPLES = 100_000  # of a mesh, about, at most; then they are farther apart
_CUT_SMALLER = 4.0  # area of a square on the edge asked for / area of a triangle cut to it, about
_PROBE = 0.1  # metres above the root: a tree that stands on a surface, or a little in it, is not enclosed


@dataclass(frozen=True, eq=False)
class Obstacle:
    """One mesh or one region."""

    field: DistanceField  # of three axes, or of two (x, y) for a region
    clearance: float  # c, metres

    def margin(self, point: Float[np.ndarray, "point 3"], within: float) -> Float[np.ndarray, " point"]:
        """m, about, metres, negative inside; infinite where it is farther than `within`."""
        point = point[:, : self.field.axes]
        margin = np.full(len(point), np.inf)
        near = np.flatnonzero(self.field.roughly(point) < within + self.clearance + self.field.pitch)
        margin[near] = self.field.at(point[near]) - self.clearance
        return margin

    def clear(self, point: Float[np.ndarray, "point 3"]) -> Float[np.ndarray, " point"]:
        """What m is at least, metres; more than 0 where wood may be."""
        return self._distance(point[:, : self.field.axes]) - self._nearest

    def away(self, point: Float[np.ndarray, "point 3"]) -> Float[np.ndarray, "point 3"]:
        """Unit directions away from the obstacle; in the page's plane from a region."""
        found = np.zeros((len(point), 3))
        found[:, : self.field.axes] = self.field.away(point[:, : self.field.axes])
        return found

    def free(
        self, start: Float[np.ndarray, "branch 3"], end: Float[np.ndarray, "branch 3"], closely: bool = True
    ) -> Float[np.ndarray, " branch"]:
        """The fraction of each way from `start` to `end` before it comes too near, 0-1; about so, if not `closely`."""
        start, way = start[:, : self.field.axes], (end - start)[:, : self.field.axes]
        length = np.maximum(np.linalg.norm(way, axis=1), 1e-300)
        fraction = np.ones(len(start))
        rows = np.flatnonzero(self.field.roughly(start + 0.5 * way) - self.field.slack <= self._nearest + 0.5 * length)
        stride = self._distance(start[rows], closely)
        fraction[rows] = 0.0
        rows, stride = rows[stride > self._nearest], stride[stride > self._nearest]
        along = np.zeros(len(rows))
        while len(rows):
            ahead = np.minimum(along + stride / length[rows], 1.0)
            distance = self._distance(start[rows] + ahead[:, None] * way[rows], closely)
            ok = distance > self._nearest
            fraction[rows] = np.where(ok, ahead, along + (stride - self._nearest) / length[rows]).clip(0.0, 1.0)
            on = ok & (ahead < 1.0)
            rows, along, stride = rows[on], ahead[on], distance[on]
        return fraction

    @property
    def _nearest(self) -> float:
        """What the distance has to be at least, by what it is at least."""
        return self.clearance - self.field.apart

    def _distance(self, point, closely=True):
        return self.field.at_least(point, self.clearance) if closely else self.field.at(point) - self.field.apart


def refuse_around(meshes, root: Float[np.ndarray, "root 3"]) -> None:
    """Raises OptionError for a closed mesh that has one of these roots (metres) inside it."""
    for k, mesh in enumerate(meshes):
        if mesh.is_watertight and _holds(mesh, root):
            raise OptionError(
                f"{name_of(mesh, k)} encloses the root of the tree, so nothing could grow.",
                remedy="Move it beside the trunk. Its file counts in metres, y up, and the root is its origin: "
                "a mesh in millimetres is a thousand times too large.",
            )


def name_of(mesh, number: int) -> str:
    """How messages name a mesh: by its file, else by its place among the others (from 0)."""
    return f"The obstacle {mesh.metadata.get('name') or number + 1}"


def from_mesh(mesh, domain: Domain, most: float) -> Obstacle | None:
    """The obstacle that a trimesh.Trimesh is, on a grid of `most` corners at most; None if it lies out of the tree's reach.

    One that is not closed and has the root inside encloses nothing: the tree grows up in it."""
    low, high, pitch, band = domain.grid(*mesh.bounds, most)
    triangle = np.asarray(mesh.triangles)
    near = pieces(triangle, low, high, 2.0 * pitch)
    if len(near) == 0:
        return None
    area = 0.5 * np.linalg.norm(np.cross(near[:, 1] - near[:, 0], near[:, 2] - near[:, 0]), axis=1).sum()
    edge = min(pitch, max(_FINE * domain.spacing, np.sqrt(_CUT_SMALLER * area / _SAMPLES)))
    sample, normal = surface_samples(near, low, high, edge)
    corners = grid(low, high, pitch)
    solid = np.zeros([len(along) for along in corners], bool) if _holds(mesh, domain.root) else enclosed(triangle, corners)
    field = DistanceField.from_samples(sample, normal, corners, solid, band, APART * edge)
    return Obstacle(field, _clearance(field, domain))


def _clearance(field, domain) -> float:
    return max(_KEEPS * domain.spacing, 2.0 * field.apart)


def _holds(mesh, root) -> bool:
    """Whether a mesh is all about one of these roots, or most of it is."""
    probe = np.asarray(root, float) + [0.0, _PROBE, 0.0]
    probe = probe[((probe > mesh.bounds[0]) & (probe < mesh.bounds[1])).all(axis=1)]
    return bool((np.abs(winding(probe, np.asarray(mesh.triangles))) > ENCLOSES).any())


def from_region(outline, name: str, domain: Domain, most: float) -> Obstacle | None:
    """The obstacle that a closed outline on the page is (point 2, metres); None if it lies out of the tree's reach.

    Raises OptionError for an outline without area, and for one around the root."""
    area = _area(outline, name)
    probe = domain.root[:, :2] + [0.0, _PROBE]
    if shapely.contains_xy(area, probe[:, 0], probe[:, 1]).any():
        raise OptionError(f"{name} is drawn around the root of the tree, so nothing could grow.", remedy="Draw it beside the trunk.")
    low, high, pitch, band = domain.grid(*np.array(area.bounds).reshape(2, 2), most)
    if (low >= high).any():
        return None
    edge = _FINE * domain.spacing
    sample, normal = line_samples(np.asarray(outline, float), edge)
    corners = grid(low, high, pitch)
    x, y = np.meshgrid(*corners, indexing="ij")
    solid = shapely.contains_xy(area, x.ravel(), y.ravel()).reshape(x.shape)
    field = DistanceField.from_samples(sample, normal, corners, solid, band, 0.5 * edge)
    return Obstacle(field, _clearance(field, domain))


def _area(outline, name: str):
    outline = np.asarray(outline, float)
    ok = outline.ndim == 2 and outline.shape[1] == 2 and len(outline) >= 3 and np.isfinite(outline).all()
    area = shapely.make_valid(shapely.Polygon(outline)) if ok else shapely.Polygon()
    if area.area <= 0:
        raise OptionError(f"{name} encloses no area.", remedy="Draw it as a closed curve of three points or more, or leave it out.")
    shapely.prepare(area)
    return area
