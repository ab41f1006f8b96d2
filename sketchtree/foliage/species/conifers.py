"""Which needles and scales are there? One model is a tuft, twig or spray; `size` is the length of one needle, or of a whole spray of scales."""

from sketchtree.foliage.drawings import needles, scales
from sketchtree.foliage.leaf_model import LeafModel, seasons


CONIFERS = (
    LeafModel(
        "spruce", needles.spruce_tuft, arrangement="spiral", size=0.018, spacing=0.004, inclination=34.0, droop=0.10, planes=2,
        needle=needles.SPRUCE_NEEDLE, bundle=20,
        shoot=6.0, evergreen=True, curl=0.0, fold=0.0,
        palettes=seasons(
            ("#3c5733", "#7f9c4e", "#8ba865", "#7a5a3c"),
            ("#2f4a2e", "#516e42", "#6d8a5c", "#76563a"),
            ("#2e472e", "#4d673f", "#69845a", "#6e5238"),
        ), roughness=0.65, translucency=0.08,
    ),
    LeafModel(
        "pine", needles.pine_tuft, arrangement="fascicled", size=0.055, spacing=0.01, inclination=24.0, droop=0.04, planes=3,
        needle=needles.PINE_NEEDLE, bundle=2,
        shoot=3.0, evergreen=True, curl=0.0, fold=0.0,
        palettes=seasons(
            ("#4a653c", "#809a58", "#8fa670", "#8a6444"),
            ("#3e583a", "#68835a", "#83997a", "#84603f"),
            ("#3d5539", "#647d54", "#7e9472", "#7c5b3c"),
        ), roughness=0.65, translucency=0.08,
    ),
    LeafModel(
        "stone_pine", needles.stone_pine_tuft, arrangement="fascicled", size=0.12, spacing=0.015, inclination=26.0, droop=0.0, planes=3, needle=needles.STONE_PINE_NEEDLE, bundle=3,
        shoot=2.4, evergreen=True, curl=0.0, fold=0.0,
        palettes=seasons(
            ("#567046", "#8ca45e", "#98b076", "#94764e"),
            ("#47633e", "#748e5a", "#8ca47c", "#8c704c"),
            ("#45603c", "#6f8856", "#869c76", "#866a48"),
        ), roughness=0.6, translucency=0.08,
    ),
    LeafModel(
        "white_pine", needles.white_pine_tuft, arrangement="fascicled", size=0.09, spacing=0.012, inclination=26.0, droop=0.10, planes=3, needle=needles.WHITE_PINE_NEEDLE, bundle=2,
        shoot=3.0, evergreen=True, curl=0.0, fold=0.0,
        palettes=seasons(
            ("#4d6c4c", "#86a470", "#98b48a", "#84684c"),
            ("#40604a", "#6c8c6c", "#8aa48c", "#80664a"),
            ("#405c46", "#688668", "#849c84", "#7c6248"),
        ), roughness=0.6, translucency=0.10,
    ),
    LeafModel(
        "larch", needles.larch_twig, arrangement="spiral", size=0.028, spacing=0.014, inclination=48.0, droop=0.35, planes=2, needle=needles.LARCH_NEEDLE, bundle=4,
        shoot=6.0, curl=0.0, fold=0.0,
        palettes=seasons(
            ("#7fa04a", "#a0bd5c", "#b2cb7c", "#8a7050"),
            ("#567a3e", "#82a052", "#9cb676", "#846a4a"),
            ("#b88430", "#e0b044", "#e6c06a", "#86643e"),
        ), translucency=0.20,
    ),
    LeafModel(
        "cedar", needles.cedar_twig, arrangement="fascicled", size=0.026, spacing=0.013, inclination=46.0, droop=0.02, planes=2, needle=needles.CEDAR_NEEDLE, bundle=5,
        shoot=6.0, evergreen=True, curl=0.0, fold=0.0,
        palettes=seasons(
            ("#44624a", "#86a67c", "#98b494", "#7a6450"),
            ("#365444", "#66866c", "#86a08c", "#766250"),
            ("#36503f", "#628066", "#809a86", "#72604e"),
        ), roughness=0.6, translucency=0.08,
    ),
    LeafModel(
        "fir", needles.fir_spray, arrangement="alternate", size=0.022, spacing=0.004, inclination=42.0, droop=0.08, needle=needles.FIR_NEEDLE, bundle=16,
        shoot=6.0, evergreen=True, curl=0.10, fold=24.0,
        palettes=seasons(
            ("#3a5c38", "#86a856", "#92b06c", "#80684c"),
            ("#2a4a32", "#4c6e4a", "#6c8a66", "#7c664c"),
            ("#2a4731", "#486847", "#668262", "#766048"),
        ), roughness=0.45, translucency=0.08,
    ),
    LeafModel(
        "juniper", scales.juniper_spray, arrangement="spiral", size=0.085, spacing=0.022, inclination=38.0, droop=-0.10, planes=2, shoot=5.0, evergreen=True, curl=0.0, fold=0.0,
        palettes=seasons(
            ("#4c6a44", "#7e9c64", "#8caa78", "#7c6044"),
            ("#3e5c42", "#68866a", "#809a80", "#765c42"),
            ("#3e583f", "#627e62", "#7a9278", "#705840"),
        ), translucency=0.06,
    ),
    LeafModel(
        "cypress", scales.cypress_spray, arrangement="spiral", size=0.12, spacing=0.03, inclination=22.0, droop=-0.30, planes=2, shoot=6.0, evergreen=True, curl=0.0, fold=0.0,
        palettes=seasons(
            ("#36583a", "#5c8050", "#6c8e64", "#6a543c"),
            ("#2c4a34", "#4c6c4a", "#607e5e", "#644e3a"),
            ("#2c4733", "#486647", "#5c785a", "#604c38"),
        ), translucency=0.06,
    ),
)  # fmt: skip
