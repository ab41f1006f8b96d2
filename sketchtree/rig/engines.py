"""What does each engine make of the files? Short notes, kept in the pack; `docs/game.md` has them at length."""

_WIND = "Wind: TEXCOORD_2 = (sway, branch), TEXCOORD_3 = (phase, flutter); the formula and shaders are in docs/game.md."

NOTES: dict[str, tuple[str, ...]] = {
    "unreal": (
        "glTF (x, y, z) metres arrive as (100 x, 100 z, 100 y) centimetres; texture sets keep their numbers, v is not turned over.",
        "As foliage: import with `Force All Mesh as Type: Static Mesh` and no generated lightmap UVs, which would take TEXCOORD_1's place.",
        "Pivot Painter 2 (PivotPainter2FoliageShader) reads UV 1. PivotPos_Index: compression HDR, sRGB off, filter Nearest, no mipmaps; "
        "XVector_Extent: compression VectorDisplacementmap, sRGB off, filter Nearest, no mipmaps.",
        "A skeletal mesh keeps four texture sets: TEXCOORD_4 and 5 are then dropped.",
        "NAME_collision holds the coarsest wood with UCP_ capsules about it; Static Mesh editor, Collision, `Copy Collision from Selected Static Mesh`.",
    ),
    "unity": (
        "glTFast turns x over (x' = -x) and every texture place's v: uv3 = (sway, 1 - branch), uv4 = (phase, 1 - flutter).",
        "TEXCOORD_1, 2, 3, 4, 5 are Mesh.uv2, uv3, uv4, uv5, uv6; in Shader Graph UV1 to UV3 are the first three.",
        "LODGroup: put the levels' renderers in order; `coverage` of the levels is the transition height. Capsules: CapsuleCollider from the manifest.",
    ),
    "godot": (
        "TEXCOORD_1 is UV2, TEXCOORD_2 and 3 are CUSTOM0.xy and CUSTOM0.zw, TEXCOORD_4 and 5 are CUSTOM1.xy and CUSTOM1.zw.",
        "NAME_collision: nodes ending in -convcolonly become convex collision shapes, the one ending in -noimp is left out.",
        "Levels: one MeshInstance3D each with visibility ranges, or LOD0 alone with Godot's own levels.",
    ),
    "three": (
        "Attributes uv1, uv2, uv3; the others by their names in small letters (color_1, texcoord_4, texcoord_5).",
        "THREE.LOD takes the levels; the bones are a THREE.Skeleton as loaded.",
    ),
    "blender": ("COLOR_1 arrives as a second colour attribute, texture sets as UV maps with v turned over; y up becomes z up.",),
}


def notes() -> dict[str, list[str]]:
    """The notes of every engine, the wind's first."""
    return {engine: [_WIND, *lines] for engine, lines in NOTES.items()}
