"""Skeletons for other programs and for ours: SWC, MTG, JSON, HDF5, and a compact form inside a glTF file."""

from sketchtree.export.skeletons.columns import write_skeleton_json
from sketchtree.export.skeletons.swc import write_swc

__all__ = ["write_skeleton_json", "write_swc"]
