"""One job: a document becomes a tree. In full, as its files will have it; in a hurry, only what was touched; or for a glance.

What was worked out for the last document is used again as far as it still holds: other leaves leave the wood alone, another season all but the colours.
"""

import dataclasses
import hashlib
import pickle
from dataclasses import dataclass

import numpy as np

from sketchtree.choose import bark_model, leaf_model
from sketchtree.drawn_tree import DrawnTree, draw_out
from sketchtree.dressing import Dress
from sketchtree.editing.document import Document
from sketchtree.editing.settled import Depths, Settled
from sketchtree.geometry.radii import PipeRadii
from sketchtree.keys import root_key
from sketchtree.options import TreeOptions
from sketchtree.pipeline import LeafyTree, foliage, grow, weathered
from sketchtree.propagate.after.cutting import bears
from sketchtree.similarity import Similarity
from sketchtree.studio import messages
from sketchtree.studio.making.basis import Basis
from sketchtree.studio.making.chunks import DETAIL, Chunks, chunks_of, owners
from sketchtree.studio.making.frames import Arrays
from sketchtree.studio.making.limb_table import limb_table
from sketchtree.studio.making.watching import Stopped, pulses
from sketchtree.templates.store.database import Database
from sketchtree.watch import Watch

_GROWING = ("generations", "fill", "max_segments", "density", "light")


_MOST = 16  # limbs that are hurried; more of them come with the full tree, which takes hardly longer
_COARSE = DETAIL.coarser(2.0)
_SAME = 0.003  # of the height: a limb that moved less stays as it is shown until the full tree comes


@dataclass(eq=False)
class Bench:
    """What lies on the bench from the last job."""

    templates: Database
    drawn: tuple[str, DrawnTree] | None = None
    grown: tuple[str, object] | None = None
    standing: tuple[str, object] | None = None
    leafy: tuple[str, LeafyTree] | None = None


def signature(*parts: object) -> str:
    """The same for equal parts."""
    return hashlib.blake2b(pickle.dumps(parts), digest_size=16).hexdigest()


def drawn_tree(bench: Bench, document: Document, watch: Watch) -> DrawnTree:
    """The drawn limbs in space."""
    at = signature(tuple(document.strokes.values()), document.edits, document.settled, document.reading, document.cloud, document.seed)
    if bench.drawn is None or bench.drawn[0] != at:
        drawn = draw_out(
            document.sketch, bench.templates, key=root_key(document.seed), options=document.reading, edits=document.edits, settled=document.settled, cloud=document.cloud, watch=watch
        )
        bench.drawn = at, drawn
    return bench.drawn[1]


def leafy_tree(bench: Bench, document: Document, drawn: DrawnTree, watch: Watch) -> LeafyTree:
    """The whole tree, without its meshes."""
    key, options, at = root_key(document.seed), document.tree, bench.drawn[0]
    at_grown = signature(at, [getattr(options, name) for name in _GROWING])
    if bench.grown is None or bench.grown[0] != at_grown:
        with watch("propagate"):
            bench.grown = at_grown, grow(drawn, options, key=key, pulse=pulses(watch, 0.0, 0.4))
    at_standing = signature(at_grown, options.sag, options.shed, options.shed_twigs, options.untangle, options.prune)
    if bench.standing is None or bench.standing[0] != at_standing:
        with watch("propagate"):
            bench.standing = at_standing, weathered(drawn, bench.grown[1], options, pulse=pulses(watch, 0.4, 1.0))
    at_leafy = signature(at_standing, options.leaf, options.bark, options.season)
    if bench.leafy is None or bench.leafy[0] != at_leafy:
        dress = Dress(bark_model(options.bark, drawn.habit), leaf_model(options.leaf, drawn.habit, bench.templates), options.season, drawn.habit)
        skeleton, warnings = bench.standing[1]
        with watch("foliage"):
            leaves, flowers = foliage(skeleton, dress, key=key, pulse=pulses(watch, 0.0, 1.0))
        bench.leafy = at_leafy, LeafyTree(skeleton, leaves, flowers, dress, warnings)
    return bench.leafy[1]


def tree_frame(
    revision: int, phase: str, document: Document, drawn: DrawnTree, tree: LeafyTree, chunks: Chunks, known: dict[str, str], basis: Basis | None = None
) -> tuple[bytes, dict[str, str]]:
    """(the frame, digest of every chunk there is now). Chunks whose digest is `known` are left out; after a hurried job those of `basis` stay."""
    arrays, sent, digests = Arrays(), [], {}
    for chunk in chunks.chunks:
        digests[str(chunk.owner)] = digest = chunk.digest()
        if known.get(str(chunk.owner)) != digest:
            sent.append(chunk.put(arrays, digest))
    cards = []
    for k, (name, card) in enumerate(zip(chunks.card_names, chunks.cards, strict=True)):
        for column, (kind, values) in card.arrays.items():
            arrays.put(f"card{k}/{column}", kind, values)
        cards.append(messages.Card(name=name, array=f"card{k}/", material=card.wears))
    skeleton, similarity = tree.skeleton, drawn.similarity
    present = list(digests) if basis is None else [name for name in dict.fromkeys((*basis.owners, *digests)) if int(name) in drawn.settled.limbs]
    root = np.asarray(similarity.translate) / -similarity.scale
    points = skeleton.tip
    head = messages.Tree(
        revision=revision, phase=phase, scale=similarity.scale, root=[float(root[0]), float(-root[1])], owners=present, chunks=sent, cards=cards,
        materials=[material_of(key, one) for key, one in chunks.materials.items()], limbs=limb_table(drawn),
        segments=skeleton.segment_count if basis is None else basis.segments,
        drawn=drawn.skeleton.segment_count,
        leaves=len(tree.leaves) if basis is None else basis.leaves,
        triangles=list(chunks.triangles if basis is None else basis.triangles),
        height=skeleton.height if basis is None else basis.height,
        low=list(points.min(axis=0) if basis is None else np.minimum(points.min(axis=0), basis.low)),
        high=list(points.max(axis=0) if basis is None else np.maximum(points.max(axis=0), basis.high)),
        template=drawn.exemplar.name if drawn.exemplar else None, leaf=tree.dress.leaf, bark=tree.dress.bark, warnings=list(drawn.warnings + tree.warnings), arrays=[],
    )  # fmt: skip
    return arrays.frame(head), digests


def material_of(key: str, one) -> messages.Material:
    """A material as pages are told."""
    maps = {"color": one.base_color_texture, "normal": one.normal_texture, "roughness": one.roughness_texture, "translucency": one.translucency_texture}
    return messages.Material(
        key=key, maps=[name for name, texture in maps.items() if texture is not None], color=[float(value) for value in one.base_color],
        roughness=float(one.roughness), cutoff=one.alpha_cutoff, double_sided=bool(one.double_sided), translucency=float(one.translucency),
    )  # fmt: skip


def hurried(bench: Bench, document: Document, basis: Basis | None, watch: Watch) -> tuple[DrawnTree, LeafyTree, Chunks]:
    """Only what was touched: solved in the shortest run, grown, with leaves; nothing is weathered. What stays is taken as it is. Of a tree that the pages have nothing
    of yet, the bare drawn limbs."""
    key = root_key(document.seed)
    similarity = None if basis is None else Similarity(basis.scale, basis.translate)
    drawn = draw_out(
        document.sketch, bench.templates, key=key, options=document.reading, edits=document.edits, settled=document.settled, cloud=document.cloud, similarity=similarity, quick=True,
        watch=watch,
    )
    touched = frozenset(drawn.settled.limbs) if basis is None else _moved(drawn, basis.settled)
    if len(touched) > _MOST:
        raise Stopped
    with watch("propagate"):
        grown = grow(drawn, _light(document.tree, bare=basis is None), key=key, only=touched)
        radius = np.full(len(grown.skeleton), np.nan)
        radius[grown.drawn_row] = drawn.radius
        whole = PipeRadii(drawn.habit, radius, grown.tip_weight)(grown.skeleton)
        mine = np.isin(owners(whole), list(touched))
        part = whole.select(bears(whole.parent, mine) | mine) if touched else whole.select(whole.is_base)
    options = document.tree
    dress = Dress(bark_model(options.bark, drawn.habit), leaf_model(options.leaf, drawn.habit, bench.templates), options.season, drawn.habit)
    if basis is None:
        dress = dataclasses.replace(dress, leaf=None)
    with watch("foliage"):
        leaves, flowers = foliage(part, dress, key=key)
    tree = LeafyTree(part, leaves, flowers, dress, ())
    with watch("mesh"):
        chunks = chunks_of(tree, key=key, only=touched, detail=_COARSE) if touched else Chunks((), (), (), {}, (0, 0))
    return drawn, tree, chunks


def _moved(drawn: DrawnTree, before: Settled) -> frozenset[int]:
    """Limbs that are new, or not where they were."""
    near = _SAME * max(drawn.graph.height, 1e-300)

    def same(limb: int, now: Depths) -> bool:
        was = before.limbs.get(limb)
        if was is None or was.parent != now.parent or np.abs(was.course - now.course).max() > near:
            return False
        return bool(np.abs(np.interp(was.share, now.share, now.depth) - was.depth).max() <= near)

    return frozenset(limb for limb, now in drawn.settled.limbs.items() if not same(limb, now))


def _light(options: TreeOptions, *, bare: bool) -> TreeOptions:
    """The same options without what takes long."""
    return dataclasses.replace(options, fill=False, light=0.0, generations=0 if bare else options.generations)
