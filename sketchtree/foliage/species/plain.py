"""Which leaf models are no species'? Not listed among the leaves that a tree is offered, but worn by whoever asks for them."""

from sketchtree.foliage.drawings import plain
from sketchtree.foliage.leaf_model import LeafModel, seasons

PLAIN = (
    LeafModel(
        "rectangle", plain.rectangle, arrangement="spiral", size=0.03, spacing=0.02, droop=0.0, fold=0.0, curl=0.0,
        palettes=seasons(
            ("#8ca84c", "#aabb60", "#aabb60", "#9a8a55"),
            ("#4e6a2e", "#748f43", "#748f43", "#7d8350"),
            ("#9a5a26", "#c59a3c", "#c59a3c", "#7a5a36"),
        ),
    ),
)  # fmt: skip
