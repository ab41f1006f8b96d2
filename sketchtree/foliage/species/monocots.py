"""Which leaves do palms and dragon trees have? A palm's model is one leaflet of a frond, or one fold of a fan."""

from sketchtree.foliage.drawings import entire
from sketchtree.foliage.leaf_model import LeafModel, seasons


MONOCOTS = (
    LeafModel(
        "palm", entire.palm_leaflet, arrangement="frond", size=0.45, spacing=0.035, inclination=52.0, droop=0.10, fold=30.0, curl=0.16,
        evergreen=True,
        palettes=seasons(
            ("#5f7648", "#93a368", "#b0b888", "#b0a06a"),
            ("#566e44", "#8b9c64", "#a8b184", "#a8996a"),
            ("#5a6f44", "#959d62", "#aeb182", "#a8966a"),
        ), roughness=0.55, translucency=0.15,
    ),
    LeafModel(
        "fan_palm", entire.fan_segment, arrangement="frond", size=0.70, spacing=0.05, inclination=0.0, droop=0.10, fold=34.0, curl=0.22, fan=34, evergreen=True,
        palettes=seasons(
            ("#58763f", "#86a35c", "#a8b880", "#98985e"),
            ("#4c693a", "#7a9654", "#9fb07a", "#8e905e"),
            ("#4c6739", "#7a9252", "#9cac78", "#8e8c5c"),
        ), roughness=0.5, translucency=0.15,
    ),
    LeafModel(
        "dragon_tree", entire.sword, arrangement="spiral", size=0.45, spacing=0.012, inclination=64.0, droop=0.04, fold=16.0, curl=0.08, shoot=1.0, evergreen=True,
        palettes=seasons(
            ("#5c7a5e", "#8aa585", "#9cb494", "#a58a5c"),
            ("#506e54", "#7c987a", "#94ac8e", "#a08458"),
            ("#4f6b52", "#7a9478", "#90a88a", "#9c8056"),
        ), roughness=0.5, translucency=0.12,
    ),
)  # fmt: skip
