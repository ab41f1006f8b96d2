"""Freehand strokes in, a complete textured 3D tree out."""

from sketchtree.version import __version__

__all__ = ["__version__"]
