"""Which colour means what in an overlay. Branching orders keep apart for colour-blind eyes too (Okabe & Ito's palette)."""

ORDER = ("#4a3423", "#0072b2", "#009e73", "#cc79a7", "#e69f00")  # trunk, 1, 2, 3, 4 and more
ORDER_NAME = ("trunk", "first order", "second order", "third order", "fourth order and more")
ROOT = "#8c564b"
DOUBT = "#d7261e"
DRAWN = "#9a9a9a"  # the strokes as they stand in the file
ROLE = {
    "crown": "#7aa92f",
    "obstacle": "#5b3fa0",
    "ground": "#b8860b",
    "shadow": "#8f8f9f",
    "leaves": "#55aa55",
    "hatching": "#a6761d",
    "speckle": "#c0a0c0",
    "paper": "#c8c8b8",
    "dot": "#c0a0c0",
}
OTHER_ROLE = "#7f7f7f"
"""For a role this table does not know."""
