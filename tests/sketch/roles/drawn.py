"""Shapes that people draw trees with, and what the reader makes of them; y up."""

import dataclasses

import numpy as np

from sketchtree.sketch.reading import sketch_graph
from sketchtree.sketch.roles.measures import Measures
from sketchtree.sketch.strokes import Sketch, Stroke


def ring(radius, centre=(0.0, 80.0), count=40, begin=-0.5 * np.pi, end=1.5 * np.pi, high=None):
    """A circle, an arc of it, or an ellipse that is `high` above its middle."""
    angle = np.linspace(begin, end, count)
    return np.c_[centre[0] + radius * np.cos(angle), centre[1] + (high or radius) * np.sin(angle)]


def cloud(radius, centre=(0.0, 80.0), lobes=7, count=90):
    """A lobed outline."""
    angle = np.linspace(-0.5 * np.pi, 1.5 * np.pi, count)
    out = radius * (1 + 0.12 * np.abs(np.sin(0.5 * lobes * angle)))
    return np.c_[centre[0] + out * np.cos(angle), centre[1] + out * np.sin(angle)]


def box(width, height, x=0.0, y=0.0):
    """A rectangle that stands on (x, y)."""
    return np.array([(x - width / 2, y), (x + width / 2, y), (x + width / 2, y + height), (x - width / 2, y + height)])


def wedge(width, y, height):
    """A triangle, as a tier of a fir."""
    return np.array([(-width / 2, y), (width / 2, y), (0.0, y + height)])


def edge(x, low=0.0, high=45.0, flare=6.0):
    """One edge of a trunk, flaring at the foot."""
    side = np.sign(x) * flare
    return np.array([(x + side, low), (x + 0.3 * side, low + 0.2 * (high - low)), (x, low + 0.5 * (high - low)), (x, high)])


def scribble(radius=40.0, centre=(0.0, 90.0)):
    """A line that runs again and again through a round space."""
    t = np.linspace(0, 1, 400)
    return np.c_[centre[0] + radius * np.cos(62 * t) * np.cos(9 * t), centre[1] + radius * np.sin(57 * t) * np.cos(5 * t)]


def painted(points, name="painted"):
    """A painted area."""
    return Stroke(name, points, closed=True, filled=True)


def closed(points, name="closed"):
    """A line that the file closes."""
    return Stroke(name, points, closed=True)


def drawing(*things):
    """A sketch of strokes, or of points: s0, s1, …"""
    strokes = [dataclasses.replace(thing, id=f"s{k}") if isinstance(thing, Stroke) else Stroke(f"s{k}", np.asarray(thing, float)) for k, thing in enumerate(things)]
    return Sketch(tuple(strokes))


def graph_of(*things):
    """The graph of such a sketch."""
    return sketch_graph(drawing(*things))


def roles(graph):
    """Stroke → role, of all that is no branch."""
    return {role.stroke: role.role for role in graph.roles}


def measured(*things):
    """(measures, all strokes free) of such a sketch."""
    strokes = drawing(*things).strokes
    return Measures.of(strokes), np.ones(len(strokes), bool)
