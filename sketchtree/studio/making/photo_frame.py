"""How does the photo's tree, or all of them, come to the page? Whole, as a `Tree` of phase "photo", at the place where the photo lies under the page."""

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from sketchtree.limb_ids import child_limb_id
from sketchtree.photo.photo import Photo
from sketchtree.pipeline import LeafyTree
from sketchtree.similarity import Similarity
from sketchtree.skeleton import Kind
from sketchtree.studio import messages
from sketchtree.studio.making.chunks import DETAIL, Chunks, chunks_of
from sketchtree.studio.making.frames import Arrays
from sketchtree.studio.making.photo_asked import Place
from sketchtree.studio.making.textures import unnamed
from sketchtree.studio.making.watching import pulses
from sketchtree.studio.making.work import material_of
from sketchtree.watch import Watch


@dataclass(frozen=True)
class Frame:
    """Where trees stand, and what is said of them."""

    revision: int
    scale: float  # metres a page unit
    root: tuple[float, float]  # of the world's origin on the page, y down
    template: str | None  # of the first tree
    warnings: tuple[str, ...]


def photo_frame(
    revision: int, similarity: Similarity, template: str | None, trees: Sequence[tuple[object, LeafyTree]], place: Place, photo: Photo, warnings: tuple[str, ...], watch: Watch
) -> tuple[bytes, dict[tuple[str, str], bytes]]:
    """(the frame of a photo's trees, maps of materials that it alone has). `similarity`: from the photo's pixels, y up; `template`: of the first tree; `trees`: each with its key."""
    root = place.to_page(-np.asarray(similarity.translate)[None, :2] / similarity.scale, photo)[0]
    return whole_frame(Frame(revision, similarity.scale / place.unit(photo), (float(root[0]), float(-root[1])), template, warnings), trees, watch)


def whole_frame(frame: Frame, trees: Sequence[tuple[object, LeafyTree]], watch: Watch) -> tuple[bytes, dict[tuple[str, str], bytes]]:
    """The same of trees that stand anywhere."""
    with watch("mesh"):
        each = [_chunks(key, tree, number, len(trees), watch) for number, (key, tree) in enumerate(trees)]
    arrays, chunks, materials = Arrays(), [], {}
    for one in each:
        chunks += [chunk.put(arrays, chunk.digest()) for chunk in one.chunks]
        materials |= one.materials
    cards = {name: card for one in each for name, card in zip(one.card_names, one.cards, strict=True)}
    for number, card in enumerate(cards.values()):
        for column, (kind, values) in card.arrays.items():
            arrays.put(f"card{number}/{column}", kind, values)
    points = np.concatenate([tree.skeleton.tip for _, tree in trees])
    worn = trees[0][1].dress
    head = messages.Tree(
        revision=frame.revision, phase="photo", scale=frame.scale, root=list(frame.root), owners=[chunk.owner for chunk in chunks],
        chunks=chunks, cards=[messages.Card(name=name, array=f"card{number}/", material=card.wears) for number, (name, card) in enumerate(cards.items())],
        materials=[material_of(key, one) for key, one in materials.items()], limbs=[],
        segments=sum(tree.skeleton.segment_count for _, tree in trees), drawn=int(sum((tree.skeleton.kind == Kind.DRAWN).sum() for _, tree in trees)),
        leaves=sum(len(tree.leaves) for _, tree in trees), triangles=[sum(one.triangles[k] for one in each) for k in (0, 1)],
        height=max(tree.skeleton.height for _, tree in trees), low=list(points.min(axis=0)), high=list(points.max(axis=0)),
        template=frame.template, leaf=worn.leaf, bark=worn.bark, warnings=list(frame.warnings), arrays=[],
    )  # fmt: skip
    return arrays.frame(head), unnamed(materials)


def _chunks(key, tree: LeafyTree, number: int, count: int, watch: Watch) -> Chunks:
    """One tree in chunks; limbs of further trees go by other ids, since strokes of two trees may be called alike."""
    skeleton = tree.skeleton
    if number:
        tree = dataclasses.replace(tree, skeleton=skeleton.replace(limb=child_limb_id(skeleton.limb, np.full(len(skeleton), number))))
    return chunks_of(tree, key=key, detail=dataclasses.replace(DETAIL, most_triangles=DETAIL.most_triangles // count), pulse=pulses(watch, number / count, (number + 1) / count))
