"""What does the page know of each drawn limb? Where it runs in space, how sure its depth is, and what holds it."""

import numpy as np

from sketchtree.drawn_tree import DrawnTree
from sketchtree.editing.turning import on_page
from sketchtree.skeleton import Kind, TreeSkeleton
from sketchtree.studio import messages
from sketchtree.traverse import limb_chains


def limb_table(drawn: DrawnTree) -> list[messages.Limb]:
    """One row a limb that was drawn or adopted, parents first."""
    tree, found = drawn.skeleton, []
    for rows in limb_chains(tree.parent, tree.limb):
        rows = rows[~tree.is_base[rows] & (tree.kind[rows] != Kind.ROOT)]
        limb = int(tree.limb[rows[0]]) if len(rows) else None
        if limb in drawn.settled.limbs:
            found.append(_limb(drawn, tree, limb, rows))
    return found


def _limb(drawn: DrawnTree, tree: TreeSkeleton, limb: int, rows) -> messages.Limb:
    known, held = drawn.settled.limbs[limb], drawn.edits.held.get(limb)
    path = np.concatenate([tree.curve(rows[0])[:1], *[tree.curve(row)[1:] for row in rows]])
    share = _share(path, known.view_deg)
    sd = np.interp(share, known.share, np.nan_to_num(known.sd, nan=-1.0)) * drawn.similarity.scale
    return messages.Limb(
        id=str(limb),
        strokes=list(known.strokes),
        parent=None if known.parent is None else str(known.parent),
        order=int(tree.order[rows[0]]),
        locked=limb in drawn.edits.adopted or (held is not None and held.whole),
        held=[] if held is None else held.share.tolist(),
        share=share.tolist(),
        path=path.ravel().tolist(),
        sd=np.where(sd < 0, -1.0, sd).tolist(),
        view_deg=known.view_deg,
        was=str(drawn.edits.adopted[limb].was) if limb in drawn.edits.adopted else None,
    )


def _share(path, view_deg: float):
    """How far along it each point is on the page it was drawn on."""
    page = on_page(path, view_deg, 0.0)[:, :2]
    along = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(page, axis=0), axis=1))]
    return along / along[-1] if along[-1] > 0 else np.linspace(0.0, 1.0, len(path))
