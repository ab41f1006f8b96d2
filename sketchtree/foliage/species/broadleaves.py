"""Which simple leaves are there? Colours are set by eye after living leaves: brighter and yellower in spring, the species' own in autumn."""

from sketchtree.foliage.drawings import entire, lobed, toothed
from sketchtree.foliage.leaf_model import LeafModel, seasons


BROADLEAVES = (
    LeafModel(
        "oak", lobed.oak, spur=7, every=5, arrangement="alternate", size=0.095, spacing=0.035, inclination=52.0, droop=0.22, fold=12.0, curl=0.10,
        palettes=seasons(
            ("#93994f", "#b0a65e", "#c9c68a", "#9a8a55"),
            ("#4e642c", "#71833f", "#a3ab6c", "#7d8350"),
            ("#7a4a26", "#b5873c", "#b98d56", "#7a5a36"),
        ),
    ),
    LeafModel(
        "beech", entire.beech, spur=7, every=5, arrangement="alternate", size=0.075, spacing=0.032, inclination=55.0, droop=0.22, fold=10.0, curl=0.08,
        palettes=seasons(
            ("#8fae4c", "#a9bf60", "#c6d28c", "#a59a5c"),
            ("#4d6a2e", "#769243", "#a3b56c", "#84703f"),
            ("#9a4e22", "#cf9440", "#c99a5a", "#7e5530"),
        ), roughness=0.5, translucency=0.45,
    ),
    LeafModel(
        "maple", lobed.maple, spur=3, every=2, arrangement="decussate", size=0.11, spacing=0.06, inclination=58.0, droop=0.35, fold=9.0, curl=0.10,
        palettes=seasons(
            ("#95ab4e", "#b3bf62", "#c8d08a", "#a08a4a"),
            ("#4c6b31", "#759048", "#a5b877", "#93804a"),
            ("#c0562a", "#dfb23c", "#d9b765", "#a5673a"),
        ),
    ),
    LeafModel(
        "birch", toothed.birch, spur=6, every=3, arrangement="alternate", size=0.05, spacing=0.026, inclination=60.0, droop=0.55, fold=8.0, curl=0.08,
        blossom="birch_catkin", blossom_share=0.3,
        palettes=seasons(
            ("#9db554", "#b4c66c", "#cbd693", "#a3a260"),
            ("#587538", "#84994c", "#afbb78", "#90894f"),
            ("#c79a35", "#e0c052", "#e2cc7c", "#a98a45"),
        ),
    ),
    LeafModel(
        "willow", toothed.willow, arrangement="spiral", size=0.10, spacing=0.022, inclination=38.0, droop=0.60, fold=9.0, curl=0.16, shoot=6.0,
        blossom="willow_catkin", blossom_nodes=4, blossom_share=0.5,
        palettes=seasons(
            ("#a5b960", "#bac979", "#d2dba2", "#b0aa62"),
            ("#6a8548", "#9aac6c", "#bcc794", "#a09a58"),
            ("#b89a3c", "#d3bf5e", "#dccf8a", "#a98f4c"),
        ), roughness=0.5,
    ),
    LeafModel(
        "poplar", toothed.poplar, spur=7, every=2, arrangement="spiral", size=0.06, spacing=0.03, inclination=50.0, droop=0.40, fold=9.0, curl=0.06,
        palettes=seasons(
            ("#98ad52", "#b0bd62", "#ccd38e", "#b0a25a"),
            ("#547437", "#82994b", "#b2bd80", "#a09a5c"),
            ("#c59a32", "#dcbd4a", "#e0cb7a", "#b09248"),
        ), roughness=0.45,
    ),
    LeafModel(
        "apple", toothed.apple, spur=6, every=3, arrangement="spiral", size=0.075, spacing=0.03, inclination=55.0, droop=0.25, fold=20.0, curl=0.16,
        blossom="apple_blossom", blossom_nodes=3, blossom_share=0.75,
        palettes=seasons(
            ("#92aa52", "#aaba68", "#c4cd90", "#a08c56"),
            ("#4c672f", "#738b48", "#a3b078", "#8b7448"),
            ("#a5662c", "#c9a545", "#ccb06c", "#8a5e38"),
        ),
    ),
    LeafModel(
        "hazel", toothed.hazel, spur=4, every=3, arrangement="alternate", size=0.09, spacing=0.045, inclination=58.0, droop=0.30, fold=8.0, curl=0.12,
        blossom="hazel_catkin", blossom_share=0.4,
        palettes=seasons(
            ("#96ac50", "#adbc64", "#c6d08c", "#9d8c58"),
            ("#557436", "#7f9549", "#a8b674", "#8a7a4c"),
            ("#b98f38", "#d6b850", "#d9c47c", "#94783f"),
        ), roughness=0.75,
    ),
    LeafModel(
        "lime", toothed.lime, spur=6, every=3, arrangement="alternate", size=0.065, spacing=0.032, inclination=58.0, droop=0.38, fold=9.0, curl=0.10,
        palettes=seasons(
            ("#9bb554", "#b3c66a", "#cbd690", "#a8a05e"),
            ("#52723a", "#7f984e", "#b0be7c", "#98905a"),
            ("#bf9a35", "#dcc04e", "#e0cc7c", "#a58a48"),
        ), translucency=0.42,
    ),
    LeafModel(
        "elm", toothed.elm, spur=7, every=4, arrangement="alternate", size=0.085, spacing=0.033, inclination=56.0, droop=0.28, fold=16.0, curl=0.12,
        palettes=seasons(
            ("#95ae50", "#adbe66", "#c6d08e", "#a08c56"),
            ("#4a652f", "#708a48", "#9fae74", "#8a7a4c"),
            ("#b88f36", "#d4b34c", "#d8c078", "#94783f"),
        ), roughness=0.75,
    ),
    LeafModel(
        "alder", toothed.alder, spur=4, every=3, arrangement="spiral", size=0.07, spacing=0.04, inclination=55.0, droop=0.25, fold=8.0, curl=0.08, blossom="alder_catkin", blossom_share=0.35,
        palettes=seasons(
            ("#869f4c", "#a0b360", "#bccb8a", "#9a8c58"),
            ("#40592e", "#658044", "#96a86e", "#857a4c"),
            ("#7c7436", "#97883f", "#b0a468", "#80703f"),
        ), roughness=0.42, translucency=0.28,
    ),
    LeafModel(
        "hornbeam", toothed.hornbeam, spur=7, every=5, arrangement="alternate", size=0.075, spacing=0.03, inclination=55.0, droop=0.22, fold=12.0, curl=0.10,
        palettes=seasons(
            ("#95b24e", "#adc064", "#c8d28e", "#a59a5c"),
            ("#50702f", "#789446", "#a6b873", "#86743f"),
            ("#bd8f34", "#dcb648", "#dcc078", "#8a6838"),
        ), translucency=0.42,
    ),
    LeafModel(
        "cherry", toothed.cherry, spur=6, every=3, arrangement="spiral", size=0.10, spacing=0.03, inclination=52.0, droop=0.42, fold=16.0, curl=0.16, blossom="cherry_blossom", blossom_nodes=5, blossom_share=0.85,
        palettes=seasons(
            ("#97a350", "#b2b566", "#c8cb90", "#a86a50"),
            ("#4e6a32", "#76904a", "#a8b67c", "#a0604a"),
            ("#b8482a", "#e0913c", "#dca864", "#9c4c38"),
        ),
    ),
    LeafModel(
        "hawthorn", lobed.hawthorn, spur=4, every=2, arrangement="spiral", size=0.042, spacing=0.018, inclination=55.0, droop=0.15, fold=12.0, curl=0.10, blossom="hawthorn_blossom", blossom_nodes=3, blossom_share=0.7,
        palettes=seasons(
            ("#8fae4a", "#a8c05e", "#c4d288", "#96845a"),
            ("#46632e", "#6c8844", "#9db070", "#82714a"),
            ("#9c4c2a", "#c98a3e", "#c69a5c", "#7e4f34"),
        ), roughness=0.45,
    ),
    LeafModel(
        "plane", lobed.plane, spur=3, every=2, arrangement="alternate", size=0.15, spacing=0.06, inclination=58.0, droop=0.38, fold=9.0, curl=0.12,
        palettes=seasons(
            ("#9db05a", "#b4c070", "#ccd396", "#a8985a"),
            ("#5a7838", "#869c50", "#b4c080", "#a0905a"),
            ("#9c6c32", "#c8a046", "#cdae6e", "#8e6a3c"),
        ),
    ),
    LeafModel(
        "lilac", entire.lilac, arrangement="decussate", size=0.085, spacing=0.05, inclination=54.0, droop=0.25, fold=16.0, curl=0.12, blossom="lilac_panicle", blossom_share=0.75,
        palettes=seasons(
            ("#8fab50", "#a8bc66", "#c4ce8e", "#9c8c5a"),
            ("#46643a", "#6c8a50", "#a0b07a", "#88805a"),
            ("#8f8238", "#b09a48", "#c0ae70", "#857048"),
        ), roughness=0.5, translucency=0.3,
    ),
    LeafModel(
        "cercis", entire.lilac, arrangement="alternate", size=0.085, spacing=0.045, inclination=62.0, droop=0.40, fold=10.0, curl=0.08,
        blossom="cercis_blossom", blossom_on="old wood", blossom_share=0.75,
        palettes=seasons(
            ("#a07a4a", "#a8a85c", "#c4b47e", "#9a6a58"),
            ("#4f7040", "#7a9a58", "#a8b880", "#8f7a5a"),
            ("#b89a34", "#d6bc4c", "#dccb80", "#a08448"),
        ), roughness=0.55, translucency=0.4,
    ),
    LeafModel(
        "olive", entire.olive, arrangement="decussate", size=0.065, spacing=0.016, inclination=48.0, droop=0.10, fold=12.0, curl=0.06, shoot=4.0, evergreen=True,
        palettes=seasons(
            ("#70814e", "#aab494", "#b6bea0", "#8c8c60"),
            ("#5a6e46", "#a2ad92", "#aeb79c", "#8a8a64"),
            ("#5a6d46", "#9ea98e", "#aab298", "#8a8864"),
        ), roughness=0.5, translucency=0.12,
    ),
)  # fmt: skip
