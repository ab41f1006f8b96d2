"""A material as UsdPreviewSurface, with its textures: specification 2.6 of Pixar's, as AR Quick Look, Blender, Houdini, Omniverse and Unreal read it.

Colours of textures are sRGB, the rest raw; normals are unpacked by scale 2 and bias −1; what a leaf's alpha cuts away falls under `opacityThreshold`.
A tint is the scale of the colour's texture.
"""

from pathlib import PurePosixPath

from pxr import Gf, Sdf, Usd, UsdGeom, UsdShade

from sketchtree.export.images import COLOR, NORMAL, encode, ending
from sketchtree.export.usd.names import prim_name
from sketchtree.geometry.mesh import Material

_PLAIN = (1.0, 1.0, 1.0)


class Materials:
    """The materials of a stage, each made when it is first asked for. `files` are the textures, by their paths from the stage."""

    def __init__(self, stage, scope: str, folder: str, palettes: dict):
        self.stage, self.scope, self.folder = stage, scope, folder
        self.palettes = palettes  # the tints of each material, by its id
        self.files: dict[str, bytes] = {}
        self._made: dict = {}
        self._taken: set[str] = set()

    def of(self, material: Material, tint=_PLAIN):
        """The UsdShade.Material, its colour multiplied by the tint."""
        key = (id(material), tuple(round(float(t), 6) for t in tint))
        if key not in self._made:
            with Usd.EditContext(self.stage, self.stage.GetRootLayer()):  # whatever variant asks, it is there for all
                UsdGeom.Scope.Define(self.stage, self.scope)
                self._made[key] = self._define(material, key[1])
        return self._made[key]

    def _define(self, material: Material, tint):
        made = UsdShade.Material.Define(self.stage, f"{self.scope}/{prim_name(material.name, self._taken)}")
        home = made.GetPath()
        surface = _shader(self.stage, f"{home}/surface", "UsdPreviewSurface")
        made.CreateSurfaceOutput().ConnectToSource(surface.CreateOutput("surface", Sdf.ValueTypeNames.Token))
        red, green, blue, alpha = material.base_color
        colour = Gf.Vec3f(red * tint[0], green * tint[1], blue * tint[2])
        albedo = self._texture(home, material, "albedo", material.base_color_texture, COLOR, "sRGB", scale=(*colour, alpha))
        _set(surface, "diffuseColor", Sdf.ValueTypeNames.Color3f, colour, albedo, "rgb")
        _set(surface, "metallic", Sdf.ValueTypeNames.Float, 0.0)
        rough = self._texture(home, material, "roughness", material.roughness_texture, COLOR, "raw")
        _set(surface, "roughness", Sdf.ValueTypeNames.Float, material.roughness, rough, "r")
        if material.normal_texture is not None:
            normal = self._texture(home, material, "normal", material.normal_texture, NORMAL, "raw", scale=(2, 2, 2, 1), bias=(-1, -1, -1, 0))
            _set(surface, "normal", Sdf.ValueTypeNames.Normal3f, None, normal, "rgb")
        if material.alpha_cutoff is not None:
            cut = self._texture(home, material, "albedo", material.base_color_texture, COLOR, "sRGB", node="opacity")  # Blender scales what it shares
            _set(surface, "opacity", Sdf.ValueTypeNames.Float, alpha, cut, "a")
            _set(surface, "opacityThreshold", Sdf.ValueTypeNames.Float, material.alpha_cutoff)
        made.GetPrim().SetCustomData({"name": material.name, "base_color": Gf.Vec4f(*map(float, material.base_color)), "translucency": float(material.translucency)})
        return made

    def _texture(self, home, material: Material, part: str, image, quality: int, space: str, *, scale=None, bias=None, node: str = ""):
        """A texture's shader, named after the part or as `node` says; None without an image."""
        if image is None:
            return None
        data, media = encode(image, quality)
        name = str(PurePosixPath(self.folder) / f"{material.name}_{part}{ending(media)}")
        self.files[name] = data
        shader = _shader(self.stage, f"{home}/{node or part}", "UsdUVTexture")
        _set(shader, "file", Sdf.ValueTypeNames.Asset, Sdf.AssetPath(name))
        _set(shader, "sourceColorSpace", Sdf.ValueTypeNames.Token, space)
        _set(shader, "wrapS", Sdf.ValueTypeNames.Token, "repeat")
        _set(shader, "wrapT", Sdf.ValueTypeNames.Token, "repeat")
        for word, value in (("scale", scale), ("bias", bias)):
            if value is not None and value != (1.0, 1.0, 1.0, 1.0):
                _set(shader, word, Sdf.ValueTypeNames.Float4, Gf.Vec4f(*map(float, value)))
        _set(shader, "st", Sdf.ValueTypeNames.Float2, None, self._place(home), "result")
        return shader

    def _place(self, home):
        """The shader that reads the texture coordinates, one a material."""
        path = f"{home}/st"
        if self.stage.GetPrimAtPath(path):
            return UsdShade.Shader(self.stage.GetPrimAtPath(path))
        reader = _shader(self.stage, path, "UsdPrimvarReader_float2")
        _set(reader, "varname", Sdf.ValueTypeNames.String, "st")
        return reader


def _shader(stage, path: str, kind: str):
    shader = UsdShade.Shader.Define(stage, path)
    shader.CreateIdAttr(kind)
    return shader


_OUTPUT = {"rgb": Sdf.ValueTypeNames.Float3, "r": Sdf.ValueTypeNames.Float, "a": Sdf.ValueTypeNames.Float, "result": Sdf.ValueTypeNames.Float2}


def _set(shader, name: str, kind, value, source=None, output: str = "") -> None:
    """An input: the output of another shader, or without one the value."""
    if source is not None:
        shader.CreateInput(name, kind).ConnectToSource(source.CreateOutput(output, _OUTPUT[output]))
    else:
        shader.CreateInput(name, kind).Set(value)
