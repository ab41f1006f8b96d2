"""Trees as glTF 2.0: written and read back."""

from sketchtree.export.gltf.read import read_asset, read_glb, read_glb_json, read_glb_skeleton
from sketchtree.export.gltf.write import GENERATOR, asset_bytes, glb_bytes, gltf_files, write_glb, write_gltf

__all__ = ["GENERATOR", "asset_bytes", "glb_bytes", "gltf_files", "read_asset", "read_glb", "read_glb_json", "read_glb_skeleton", "write_glb", "write_gltf"]
