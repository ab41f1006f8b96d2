"""Which blossoms and catkins are there? They look the same in every season; a tree bears them in spring only."""

from sketchtree.foliage.drawings import catkins, flowers
from sketchtree.foliage.leaf_model import LeafModel, always

BLOSSOMS = (
    LeafModel(
        "apple_blossom", flowers.apple_blossom, flower=True, arrangement="spiral", size=0.085, spacing=0.06, inclination=50.0, droop=-0.10, planes=2, curl=0.0, fold=0.0, translucency=0.45,
        palettes=always("#f2ccd2", "#fdf2f0", "#e2c65a", "#8a9a58"),
    ),
    LeafModel(
        "cherry_blossom", flowers.cherry_blossom, flower=True, arrangement="spiral", size=0.09, spacing=0.06, inclination=50.0, droop=0.25, planes=2, curl=0.0, fold=0.0, translucency=0.45,
        palettes=always("#f7efee", "#fffafa", "#dccb7e", "#8f9a5e"),
    ),
    LeafModel(
        "hawthorn_blossom", flowers.hawthorn_blossom, flower=True, arrangement="spiral", size=0.05, spacing=0.04, inclination=50.0, droop=-0.15, planes=2, curl=0.0, fold=0.0, translucency=0.45,
        palettes=always("#f5ece6", "#fff9f3", "#c08f80", "#8a9a5c"),
    ),
    LeafModel(
        "elder_blossom", flowers.elder_blossom, flower=True, arrangement="decussate", size=0.15, spacing=0.12, inclination=35.0, droop=-0.60, planes=3, curl=0.0, fold=0.0, translucency=0.4,
        palettes=always("#f1e9d0", "#fbf5e3", "#e3cf7a", "#98a468"),
    ),
    LeafModel(
        "chestnut_candle", flowers.chestnut_candle, flower=True, arrangement="decussate", size=0.24, spacing=0.16, inclination=20.0, droop=-1.40, planes=2, curl=0.0, fold=0.0, translucency=0.4,
        palettes=always("#f6ece2", "#fff7ee", "#e0a24a", "#93a05c"),
    ),
    LeafModel(
        "lilac_panicle", flowers.lilac_panicle, flower=True, arrangement="decussate", size=0.17, spacing=0.1, inclination=22.0, droop=-0.70, planes=2, curl=0.0, fold=0.0, translucency=0.35,
        palettes=always("#a586c4", "#cdb4e0", "#8c6cae", "#7d8a58"),
    ),
    LeafModel(
        "cercis_blossom", flowers.cercis_blossom, flower=True, arrangement="spiral", size=0.042, spacing=0.045, inclination=78.0, droop=0.05, planes=2, curl=0.0, fold=0.0, translucency=0.4,
        palettes=always("#b8549a", "#dc8cc0", "#c4629a", "#7c3a5c"),
    ),
    LeafModel(
        "hazel_catkin", catkins.hazel_catkin, flower=True, arrangement="alternate", size=0.06, spacing=0.06, inclination=40.0, droop=2.6, planes=2, curl=0.0, fold=0.0, translucency=0.3,
        palettes=always("#b99a42", "#d9c05c", "#ecd873", "#8a7048"),
    ),
    LeafModel(
        "birch_catkin", catkins.birch_catkin, flower=True, arrangement="alternate", size=0.05, spacing=0.05, inclination=35.0, droop=2.2, planes=2, curl=0.0, fold=0.0, translucency=0.25,
        palettes=always("#9a8040", "#c2a94f", "#e2cd6a", "#7c6444"),
    ),
    LeafModel(
        "alder_catkin", catkins.alder_catkin, flower=True, arrangement="spiral", size=0.075, spacing=0.06, inclination=40.0, droop=2.4, planes=2, curl=0.0, fold=0.0, translucency=0.2,
        palettes=always("#7a4a3c", "#a0664a", "#d9b84e", "#54402f"),
    ),
    LeafModel(
        "willow_catkin", catkins.willow_catkin, flower=True, arrangement="spiral", size=0.035, spacing=0.03, inclination=48.0, droop=-0.20, planes=2, curl=0.0, fold=0.0, translucency=0.3,
        palettes=always("#c4b95c", "#ded37a", "#f0dd58", "#8a8a4a"),
    ),
)  # fmt: skip
