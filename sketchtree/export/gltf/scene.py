"""How do the nodes of a file hang together?

    scene ─ tree ─ wood, leaf …                                 one level
    scene ─ tree ─ tree_LOD0 ─ wood_LOD0, leaf_LOD0 …           several: MSFT_lod on tree_LOD0 names tree_LOD1 … and with
                                                                MSFT_screencoverage from which share of the screen each serves
    scene ─ tree ─ root ─ joints …                              bones, and beside `tree` what they bend (a skinned mesh under
          ─ wood, leaf …                                        another node would be warned of); there MSFT_lod is on each part

A reader without MSFT_lod draws the finest level alone: coarser ones are in the file, not in the scene.
"""

from collections.abc import Sequence

from sketchtree.asset import Asset, Level
from sketchtree.export.capsules import capsule_meshes, capsules_as_json
from sketchtree.export.checks import check_asset
from sketchtree.export.gltf.animation import animation_entry
from sketchtree.export.gltf.instancing import instancing
from sketchtree.export.gltf.skin import add_skin, joint_nodes
from sketchtree.export.gltf.tables import Tables
from sketchtree.export.gltf.vertices import is_skinned, mesh_number
from sketchtree.export.skeletons.packed import skeleton_extras
from sketchtree.geometry.instances import Instances
from sketchtree.geometry.mesh import Mesh

LOD, COVERAGE = "MSFT_lod", "MSFT_screencoverage"


def scene_content(tables: Tables, asset: Asset, *, collision: Sequence[str] = (), extras: dict | None = None) -> dict:
    """`scene`, `scenes` and `nodes` of the document; fills the tables. `collision` names one node a capsule, if they are to be meshes too.

    Raises `ExportError` where a number is not finite.
    """
    check_asset(asset)
    scene = _Nodes(tables, asset)
    root = scene.add({"name": asset.name})
    skinned = scene.bends and any(isinstance(part, Mesh) and is_skinned(part) for level in asset.levels for part in level.parts)
    inside, beside = scene.by_part() if skinned else (scene.by_level(), [])
    inside += [scene.add({"name": mesh.name, "mesh": mesh_number(tables, mesh, mesh.name)}) for mesh in capsule_meshes(asset.capsules, collision)]
    if asset.armature is not None:
        inside.append(scene.joint)
    if inside:
        scene.nodes[root]["children"] = inside
    if asset.animation is not None and scene.joint is not None:
        tables.animations.append(animation_entry(tables, asset.animation, scene.joint, scene.morphed))
    told = _extras(asset) | (extras or {})
    return {"scene": 0, "scenes": [{"name": asset.name, "nodes": [root, *beside]} | ({"extras": told} if told else {})], "nodes": scene.nodes}


class _Nodes:
    """The nodes while they are put together."""

    def __init__(self, tables: Tables, asset: Asset):
        self.tables, self.levels, self.name = tables, asset.levels, asset.name
        self.nodes: list[dict] = []
        self.bones = asset.armature
        self.bends = asset.armature is not None
        self.joint = self.skin = None
        self.moves = asset.animation is not None
        morphs = asset.animation.morphs if self.moves else ()
        self.targets = {id(asset.parts[morph.part]): morph for morph in morphs}
        self.morphed: dict[int, int] = {}  # the node of each part that has a morph

    def add(self, node: dict) -> int:
        self.nodes.append(node)
        return len(self.nodes) - 1

    def by_level(self) -> list[int]:
        """The nodes under `tree`: the parts, or one group that knows its coarser ones."""
        if len(self.levels) == 1:
            parts = [self.part(part, part.name) for part in self.levels[0].parts if part.triangle_count]
            self._add_bones()
            return parts
        groups = []
        for number, level in enumerate(self.levels):
            parts = [self.part(part, _at_level(part.name, number)) for part in level.parts if part.triangle_count]
            groups.append(self.add({"name": f"{self.name}_LOD{number}"} | ({"children": parts} if parts else {})))
        self._add_bones()
        self._detail(groups[0], groups[1:], self.levels)
        return groups[:1]

    def by_part(self) -> tuple[list[int], list[int]]:
        """(nodes under `tree`, nodes beside it): every part knows its own coarser ones; where a level has no such part, an empty node stands for it."""
        self._add_bones()
        rows = [[part for part in level.parts if part.triangle_count] for level in self.levels]
        inside, beside = [], []
        for slot in range(max(map(len, rows))):
            drawn = [self._slot(parts, slot, number) for number, parts in enumerate(rows)]
            self._detail(drawn[0], drawn[1:], self.levels)
            (beside if "skin" in self.nodes[drawn[0]] else inside).append(drawn[0])
        return inside, beside

    def _slot(self, parts: list, slot: int, number: int) -> int:
        several = len(self.levels) > 1
        if slot >= len(parts):
            return self.add({"name": f"none_LOD{number}"})
        return self.part(parts[slot], _at_level(parts[slot].name, number) if several else parts[slot].name)

    def _add_bones(self) -> None:
        """The joints' nodes and, where a mesh needs it, their skin."""
        if not self.bends:
            return
        self.joint = len(self.nodes)
        self.nodes += joint_nodes(self.bones, self.joint)

    def part(self, part: Mesh | Instances, name: str) -> int:
        """A node that draws it."""
        if isinstance(part, Instances):
            return self.add({"name": name, "mesh": mesh_number(self.tables, part.mesh, name), "extensions": instancing(self.tables, part)})
        skinned = self.joint is not None and is_skinned(part)
        morph = self.targets.get(id(part))
        node = {"name": name, "mesh": mesh_number(self.tables, part, name, skinned=skinned, moves=self.moves, target=None if morph is None else morph.offset)}
        if morph is not None:
            self.morphed[morph.part] = len(self.nodes)
        if skinned and self.skin is None:
            self.skin = add_skin(self.tables, self.bones, self.joint)
        return self.add(node | ({"skin": self.skin} if skinned else {}))

    def _detail(self, finest: int, coarser: list[int], levels: Sequence[Level]) -> None:
        if coarser:
            self.nodes[finest]["extensions"] = self.nodes[finest].get("extensions", {}) | {self.tables.use(LOD): {"ids": coarser}}
            self.nodes[finest]["extras"] = {COVERAGE: [float(level.coverage) for level in levels]}


def _at_level(name: str, number: int) -> str:
    return name if "LOD" in name else f"{name}_LOD{number}"


def _extras(asset: Asset) -> dict:
    """What stands on the scene: the skeleton, what the file is about, what collides."""
    extras = skeleton_extras(asset.skeleton) if asset.skeleton is not None else {}
    if asset.about:
        extras["about"] = asset.about
    if asset.capsules is not None:
        extras["capsules"] = capsules_as_json(asset.capsules)
    return extras
