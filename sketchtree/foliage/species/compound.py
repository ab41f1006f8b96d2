"""Which leaves are made of leaflets? One model, and one card, is a whole leaf: `size` is its length without the petiole."""

from sketchtree.foliage.drawings import compound
from sketchtree.foliage.leaf_model import LeafModel, seasons


COMPOUND = (
    LeafModel(
        "horse_chestnut", compound.horse_chestnut, spur=2, every=2, arrangement="decussate", size=0.17, spacing=0.08, inclination=58.0, droop=0.45, fold=10.0, curl=0.16, blossom="chestnut_candle", blossom_share=0.7,
        palettes=seasons(
            ("#94ae4c", "#adc062", "#c8d28c", "#a8984e"),
            ("#4a682e", "#718c44", "#a4b472", "#8e8450"),
            ("#9a5a26", "#cf9a3c", "#cda45c", "#8a5e34"),
        ),
    ),
    LeafModel(
        "ash", compound.ash, spur=2, every=2, arrangement="decussate", size=0.24, spacing=0.06, inclination=55.0, droop=0.30, fold=8.0, curl=0.14,
        palettes=seasons(
            ("#93ab54", "#abbc68", "#c5cf90", "#a09a5c"),
            ("#4c6a36", "#748c4c", "#a6b47a", "#8c8852"),
            ("#b3983c", "#d0bc52", "#d8c87e", "#a08a4a"),
        ),
    ),
    LeafModel(
        "elder", compound.elder, spur=2, every=2, arrangement="decussate", size=0.19, spacing=0.06, inclination=56.0, droop=0.35, fold=8.0, curl=0.14, blossom="elder_blossom", blossom_share=0.7,
        palettes=seasons(
            ("#88a850", "#a2ba62", "#c0cc8a", "#8f9458"),
            ("#4a6c34", "#70904a", "#a2b674", "#868a52"),
            ("#a89440", "#c4aa50", "#ccb878", "#8e6a58"),
        ),
    ),
    LeafModel(
        "sumac", compound.sumac, arrangement="spiral", size=0.42, spacing=0.035, inclination=52.0, droop=0.40, fold=6.0, curl=0.24, shoot=2.0,
        palettes=seasons(
            ("#8fa650", "#aab864", "#c4cc8c", "#a06a4e"),
            ("#4c6c34", "#748e4a", "#a4b276", "#99604a"),
            ("#b03222", "#dd7632", "#d88a52", "#8e3a30"),
        ),
    ),
    LeafModel(
        "rowan", compound.rowan, spur=4, every=3, arrangement="spiral", size=0.16, spacing=0.035, inclination=55.0, droop=0.32, fold=8.0, curl=0.14,
        palettes=seasons(
            ("#8fac52", "#a8bc66", "#c4ce8e", "#a0785a"),
            ("#4c6c38", "#748e4c", "#a6b67a", "#94785a"),
            ("#b0442a", "#dd863c", "#d89a5c", "#964e3c"),
        ),
    ),
    LeafModel(
        "acacia", compound.acacia, spur=4, every=3, arrangement="spiral", size=0.055, spacing=0.014, inclination=50.0, droop=0.05, fold=12.0, curl=0.06,
        palettes=seasons(
            ("#8aa258", "#a2b46c", "#becb90", "#8a8a58"),
            ("#5a7440", "#7f9656", "#aab888", "#80805a"),
            ("#9a8a42", "#b8a04e", "#c8b676", "#86744a"),
        ), translucency=0.25,
    ),
)  # fmt: skip
