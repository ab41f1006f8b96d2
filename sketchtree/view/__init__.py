"""Pictures of trees: one, all round as a film, or a window to turn the tree in."""

from sketchtree.view.picture import NO_OPENGL, REFUSED, VIEWS, preview

__all__ = ["NO_OPENGL", "REFUSED", "VIEWS", "preview"]
