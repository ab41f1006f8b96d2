"""Which leaves are there, and how does each one look and sit?

A model is a name, a drawing (outline, veins and petiole, or a twig with needles), a palette for each
season and the few numbers that say how its card bends and how it stands on the twig.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

from sketchtree.errors import OptionError
from sketchtree.foliage import blades, needles
from sketchtree.foliage.painting import Painting
from sketchtree.foliage.seasons import Palette


@dataclass(frozen=True)
class LeafModel:
    """One kind of leaf, needle tuft or leaflet."""

    name: str
    draw: Callable[[], Painting]
    palettes: dict[str, Palette]  # spring, summer, autumn
    arrangement: str  # where a tree of another species wears it
    size: float  # metres, length of the blade or of one needle
    spacing: float  # metres between the nodes of blades or needles
    inclination: float = 55.0  # degrees between twig and leaf
    droop: float = 0.25  # 0 stiff, 1 hangs straight down
    fold: float = 14.0  # degrees that each half rises from the midrib
    curl: float = 0.10  # how far the tip bends down, blade lengths
    planes: int = 0  # 0: one blade; else how many crossed planes a tuft has
    needle: float = 1.0  # length of a needle, tuft lengths
    bundle: int = 1  # how many nodes of needles one tuft stands for
    shoot: float = 3.2  # leafy length of a twig, in the habit's twig lengths
    spur: int = 1  # nodes of a short shoot on wood older than a year; 1: that wood bears single leaves
    every: int = 4  # nodes of the twig between two short shoots
    evergreen: bool = False
    roughness: float = 0.6

    @property
    def is_blade(self) -> bool:
        """A flat leaf rather than a tuft of needles."""
        return self.planes == 0


def leaf_names() -> tuple[str, ...]:
    """The names of all leaf models."""
    return tuple(_MODELS)


def leaf_model(name: str) -> LeafModel:
    """The model of that name, or an error that lists them."""
    if name not in _MODELS:
        raise OptionError(
            f"There is no leaf model called {name!r}.",
            remedy=f"Choose one of: {', '.join(_MODELS)}.",
        )
    return _MODELS[name]


@lru_cache(maxsize=None)
def leaf_painting(name: str) -> Painting:
    """The model's drawing, made once."""
    return leaf_model(name).draw()


def _seasons(spring, summer, autumn) -> dict[str, Palette]:
    return {"spring": Palette(*spring), "summer": Palette(*summer), "autumn": Palette(*autumn)}


_MODELS = {
    model.name: model
    for model in (
        LeafModel(
            "oak", blades.oak, spur=7, every=5, arrangement="alternate", size=0.095, spacing=0.035, inclination=52.0, droop=0.22, fold=12.0, curl=0.10,
            palettes=_seasons(
                ("#93994f", "#b0a65e", "#c9c68a", "#9a8a55"),
                ("#4e642c", "#71833f", "#a3ab6c", "#7d8350"),
                ("#7a4a26", "#b5873c", "#b98d56", "#7a5a36"),
            ),
        ),
        LeafModel(
            "beech", blades.beech, spur=7, every=5, arrangement="alternate", size=0.075, spacing=0.032, inclination=55.0, droop=0.22, fold=10.0, curl=0.08,
            palettes=_seasons(
                ("#8fae4c", "#a9bf60", "#c6d28c", "#a59a5c"),
                ("#4d6a2e", "#769243", "#a3b56c", "#84703f"),
                ("#9a4e22", "#cf9440", "#c99a5a", "#7e5530"),
            ), roughness=0.5,
        ),
        LeafModel(
            "maple", blades.maple, spur=3, every=2, arrangement="decussate", size=0.11, spacing=0.06, inclination=58.0, droop=0.35, fold=9.0, curl=0.10,
            palettes=_seasons(
                ("#95ab4e", "#b3bf62", "#c8d08a", "#a08a4a"),
                ("#4c6b31", "#759048", "#a5b877", "#93804a"),
                ("#c0562a", "#dfb23c", "#d9b765", "#a5673a"),
            ),
        ),
        LeafModel(
            "birch", blades.birch, spur=6, every=3, arrangement="alternate", size=0.05, spacing=0.026, inclination=60.0, droop=0.55, fold=8.0, curl=0.08,
            palettes=_seasons(
                ("#9db554", "#b4c66c", "#cbd693", "#a3a260"),
                ("#587538", "#84994c", "#afbb78", "#90894f"),
                ("#c79a35", "#e0c052", "#e2cc7c", "#a98a45"),
            ),
        ),
        LeafModel(
            "willow", blades.willow, arrangement="spiral", size=0.10, spacing=0.022, inclination=38.0, droop=0.60, fold=9.0, curl=0.16, shoot=6.0,
            palettes=_seasons(
                ("#a5b960", "#bac979", "#d2dba2", "#b0aa62"),
                ("#6a8548", "#9aac6c", "#bcc794", "#a09a58"),
                ("#b89a3c", "#d3bf5e", "#dccf8a", "#a98f4c"),
            ), roughness=0.5,
        ),
        LeafModel(
            "poplar", blades.poplar, spur=5, every=3, arrangement="spiral", size=0.06, spacing=0.03, inclination=50.0, droop=0.40, fold=9.0, curl=0.06,
            palettes=_seasons(
                ("#98ad52", "#b0bd62", "#ccd38e", "#b0a25a"),
                ("#547437", "#82994b", "#b2bd80", "#a09a5c"),
                ("#c59a32", "#dcbd4a", "#e0cb7a", "#b09248"),
            ), roughness=0.45,
        ),
        LeafModel(
            "apple", blades.apple, spur=6, every=3, arrangement="spiral", size=0.075, spacing=0.03, inclination=55.0, droop=0.25, fold=20.0, curl=0.16,
            palettes=_seasons(
                ("#92aa52", "#aaba68", "#c4cd90", "#a08c56"),
                ("#4c672f", "#738b48", "#a3b078", "#8b7448"),
                ("#a5662c", "#c9a545", "#ccb06c", "#8a5e38"),
            ),
        ),
        LeafModel(
            "hazel", blades.hazel, spur=4, every=3, arrangement="alternate", size=0.09, spacing=0.045, inclination=58.0, droop=0.30, fold=8.0, curl=0.12,
            palettes=_seasons(
                ("#96ac50", "#adbc64", "#c6d08c", "#9d8c58"),
                ("#557436", "#7f9549", "#a8b674", "#8a7a4c"),
                ("#b98f38", "#d6b850", "#d9c47c", "#94783f"),
            ), roughness=0.75,
        ),
        LeafModel(
            "spruce", needles.spruce_tuft, arrangement="spiral", size=0.018, spacing=0.004, inclination=34.0, droop=0.10, planes=2,
            needle=needles.SPRUCE_NEEDLE, bundle=20,
            shoot=6.0, evergreen=True, curl=0.0, fold=0.0,
            palettes=_seasons(
                ("#3c5733", "#7f9c4e", "#8ba865", "#7a5a3c"),
                ("#2f4a2e", "#516e42", "#6d8a5c", "#76563a"),
                ("#2e472e", "#4d673f", "#69845a", "#6e5238"),
            ), roughness=0.65,
        ),
        LeafModel(
            "pine", needles.pine_tuft, arrangement="fascicled", size=0.055, spacing=0.01, inclination=24.0, droop=0.04, planes=3,
            needle=needles.PINE_NEEDLE, bundle=2,
            shoot=3.0, evergreen=True, curl=0.0, fold=0.0,
            palettes=_seasons(
                ("#4a653c", "#809a58", "#8fa670", "#8a6444"),
                ("#3e583a", "#68835a", "#83997a", "#84603f"),
                ("#3d5539", "#647d54", "#7e9472", "#7c5b3c"),
            ), roughness=0.65,
        ),
        LeafModel(
            "palm", blades.palm_leaflet, arrangement="frond", size=0.45, spacing=0.035, inclination=52.0, droop=0.10, fold=30.0, curl=0.16,
            evergreen=True,
            palettes=_seasons(
                ("#5f7648", "#93a368", "#b0b888", "#b0a06a"),
                ("#566e44", "#8b9c64", "#a8b184", "#a8996a"),
                ("#5a6f44", "#959d62", "#aeb182", "#a8966a"),
            ), roughness=0.55,
        ),
    )
}  # fmt: skip
