"""How is a tree cut into what grows on each drawn limb?

A *chunk* is a drawn (or adopted) limb with all that grew on it, up to the next drawn limbs. Its digest is that of its bytes: a chunk that did not change is not sent again.
"""

import hashlib
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from jaxtyping import Array, Int, Key, Shaped
from scipy.spatial import cKDTree

from sketchtree.foliage.instanced import leaf_instances
from sketchtree.foliage.leaf_materials import colours_of
from sketchtree.foliage.leaves import Leaves
from sketchtree.geometry.detail import Detail
from sketchtree.geometry.instances import Instances
from sketchtree.geometry.limbs import centre_lines
from sketchtree.geometry.mesh import Material
from sketchtree.geometry.stitch import Surface
from sketchtree.geometry.wood import frond_rows, limb_skins, plan_wood, swept_surface
from sketchtree.keys import stage_key
from sketchtree.pipeline import LeafyTree
from sketchtree.skeleton import Kind, TreeSkeleton
from sketchtree.studio import messages
from sketchtree.studio.making.frames import Arrays
from sketchtree.traverse import generations
from sketchtree.watch import Pulse, no_pulse

DETAIL = Detail(most_triangles=500_000)  # of all wood on the screen; files may have more


@dataclass(frozen=True, eq=False)
class Part:
    """A wood or leaf part of one chunk: its arrays by name, with their kinds."""

    arrays: dict[str, tuple[str, Shaped[np.ndarray, "..."]]]
    wears: str  # key of its material, or name of its card
    limbs: tuple[str, ...] = ()  # wood: the limbs it holds


@dataclass(frozen=True, eq=False)
class ChunkOf:
    """All that grows on one drawn limb."""

    owner: int
    wood: tuple[Part, ...]
    leaves: tuple[Part, ...]

    def digest(self) -> str:
        """The same for the same bytes."""
        told = hashlib.blake2b(digest_size=12)
        for part in (*self.wood, *self.leaves):
            told.update(part.wears.encode())
            for kind, column in part.arrays.values():
                told.update(np.ascontiguousarray(column))
        return told.hexdigest()

    def put(self, arrays: Arrays, digest: str) -> messages.Chunk:
        """Into a frame."""
        wood, leaves = [], []
        for k, part in enumerate(self.wood):
            name = f"{self.owner}/w{k}/"
            _put(arrays, name, part)
            wood.append(messages.Wood(array=name, material=part.wears, limbs=list(part.limbs)))
        for k, part in enumerate(self.leaves):
            name = f"{self.owner}/l{k}/"
            _put(arrays, name, part)
            leaves.append(messages.Leaves(array=name, card=part.wears))
        return messages.Chunk(owner=str(self.owner), digest=digest, wood=wood, leaves=leaves)


@dataclass(frozen=True, eq=False)
class Chunks:
    """A tree, in chunks."""

    chunks: tuple[ChunkOf, ...]
    cards: tuple[Part, ...]  # `wears` is the material's key
    card_names: tuple[str, ...]
    materials: dict[str, Material]
    triangles: tuple[int, int]  # wood, leaf; of all chunks


def owners(tree: TreeSkeleton) -> Int[np.ndarray, " segment"]:
    """Id of the drawn limb that each row is a part of or grows on."""
    owner = np.array(tree.limb)
    grown = (tree.kind != Kind.DRAWN) & (tree.kind != Kind.ROOT) & ~tree.is_base
    for rows in generations(tree.parent)[1:]:
        rows = rows[grown[rows]]
        owner[rows] = owner[tree.parent[rows]]
    return owner


def chunks_of(
    tree: LeafyTree, *, key: Key[Array, ""], only: Iterable[int] | None = None, detail: Detail = DETAIL, pulse: Pulse = no_pulse
) -> Chunks:
    """The chunks of a tree, or only those of some drawn limbs."""
    owner = owners(tree.skeleton)
    wanted = None if only is None else np.array(sorted(only), np.int64)
    wood, materials, wood_triangles = _wood(tree, owner, wanted, key, detail, pulse)
    pulse()
    leaves, cards, card_names, more, leaf_triangles = _leaves(tree, owner, wanted)
    names = sorted({*wood, *leaves})
    chunks = tuple(ChunkOf(name, tuple(wood.get(name, ())), tuple(leaves.get(name, ()))) for name in names)
    return Chunks(chunks, cards, card_names, materials | more, (wood_triangles, leaf_triangles))


def _wood(tree: LeafyTree, owner, wanted, key, detail: Detail, pulse: Pulse):
    """(owner → parts, materials, triangles)."""
    skeleton, dress = tree.skeleton, tree.dress
    frond = frond_rows(skeleton, dress.habit)
    lines = centre_lines(skeleton, apart=frond)
    pulse()
    plan = plan_wood(skeleton, lines, detail, pulse)
    of_limb = owner[lines.first_row]
    shown = np.ones(len(lines), bool) if wanted is None else np.isin(of_limb, wanted)
    found, materials, triangles = {}, {}, 0
    for _, material, among in limb_skins(lines, frond, dress.bark, dress.bark_colour):
        among = among & shown
        if not among.any():
            continue
        pulse()
        surface = swept_surface(plan, among, stage_key(key, "mesh"))
        materials[material.name] = material
        triangles += len(surface.triangle)
        pulse()
        for name, part in _by_owner(surface, of_limb, lines.limb_id, material.name):
            found.setdefault(name, []).append(part)
    return found, materials, triangles


def _by_owner(surface: Surface, of_limb, limb_id, wears: str):
    """(owner, its part of a surface), one after the other."""
    owner = of_limb[surface.limb]
    order, of_triangle = np.argsort(owner, kind="stable"), owner[surface.triangle[:, 0]]
    place = np.empty(len(order), np.int64)
    place[order] = np.arange(len(order))
    triangle_order = np.argsort(of_triangle, kind="stable")
    position, uv, limb = surface.position[order].astype(np.float32), surface.uv[order].astype(np.float32), surface.limb[order]
    normal = np.zeros((len(order), 4), np.int8)
    normal[:, :3] = np.round(surface.normal[order] * 127)
    index = place[surface.triangle[triangle_order]]
    names, first = np.unique(owner[order], return_index=True)
    last, cut = np.r_[first[1:], len(order)], np.searchsorted(of_triangle[triangle_order], np.r_[names, names[-1:] + 1])
    cut[-1] = len(index)
    for k, name in enumerate(names):
        a, b = first[k], last[k]
        ids, local = np.unique(limb[a:b], return_inverse=True)
        arrays = {
            "position": ("f4", position[a:b]), "normal": ("i1", normal[a:b]), "uv": ("f4", uv[a:b]),
            "limb": ("u2", np.minimum(local, 65535)), "index": ("u4", index[cut[k] : cut[k + 1]] - a),
        }  # fmt: skip
        yield int(name), Part({n: (kind, np.ascontiguousarray(v)) for n, (kind, v) in arrays.items()}, wears, tuple(map(str, limb_id[ids].tolist())))


def _leaves(tree: LeafyTree, owner, wanted):
    """(owner → parts, cards, their names, materials, triangles)."""
    found, cards, names, materials, triangles = {}, [], [], {}, 0
    for worn in (tree.leaves, tree.blossom):
        if worn is None or not len(worn):
            continue
        for one in leaf_instances(worn, season=tree.dress.season):
            card, wears = f"{worn.model} {one.name}", f"{one.mesh.material.name}.{colours_of(worn, tree.dress.season)}"
            of = _owner_of(one, worn, owner, tree.skeleton)
            keep = np.ones(len(one), bool) if wanted is None else np.isin(of, wanted)
            if not keep.any():
                continue
            materials[wears] = one.mesh.material
            cards.append(_card(one, wears))
            names.append(card)
            triangles += int(keep.sum()) * len(one.mesh.triangle)
            for name, part in _instances_by_owner(one, of, keep, card):
                found.setdefault(name, []).append(part)
    return found, tuple(cards), tuple(names), materials, triangles


def _owner_of(one: Instances, worn: Leaves, owner, tree: TreeSkeleton):
    """The drawn limb of every instance; a short shoot's is that of the wood it is nearest to."""
    if one.source is not None:
        return owner[worn.segment[one.source]]
    rows = np.flatnonzero(~tree.is_base)
    _, nearest = cKDTree((tree.tip[rows] + tree.start[rows]) / 2).query(one.translation)
    return owner[rows[nearest]]


def _card(one: Instances, wears: str) -> Part:
    mesh = one.mesh
    return Part({"position": ("f4", mesh.position), "normal": ("f4", mesh.normal), "uv": ("f4", mesh.uv), "index": ("u4", mesh.triangle)}, wears)


def _instances_by_owner(one: Instances, of, keep, card: str):
    rows = np.flatnonzero(keep)
    rows = rows[np.argsort(of[rows], kind="stable")]
    place, scale = one.translation[rows].astype(np.float32), one.scale[rows].astype(np.float32)
    turn = np.round(one.rotation[rows] * 32767).astype(np.int16)
    tint = np.full((len(rows), 3), 255, np.uint8)
    if one.color is not None:
        tint = np.round(np.clip(one.color[rows, :3], 0.0, 1.0) * 255).astype(np.uint8)
    names, first = np.unique(of[rows], return_index=True)
    for name, a, b in zip(names, first, np.r_[first[1:], len(rows)], strict=True):
        yield int(name), Part({"place": ("f4", place[a:b]), "turn": ("i2", turn[a:b]), "scale": ("f4", scale[a:b]), "tint": ("u1", tint[a:b])}, card)


def _put(arrays: Arrays, name: str, part: Part) -> None:
    for column, (kind, values) in part.arrays.items():
        arrays.put(name + column, kind, values)
