"""Draws one picture in a process of its own: `python -P child.py REQUEST.npz OUT.png`, opens a window: `… REQUEST.npz window`, or draws a film: `… REQUEST.npz film`.

VTK ends the process where no OpenGL can be had, so `picture.py` and `window.py` run this file as a child. It imports nothing
of the package. The request holds, for each mesh k, `k.position`, `k.normal`, `k.uv`, `k.triangle`, `k.tint`,
`k.light` (sun and sky, 0-1), `k.albedo` (sRGB, 4 channels), `k.normal_map`, `k.look` (cutoff, leaf, gloss), the
ground's light, and the cameras; `parallel`, the height of what is seen, where there is to be no perspective.

Each line that a film is told names a file of changes, a tab, and the PNG to draw; the line comes back when it is drawn. Changes are a `camera`, the light
on the `ground`, and of any mesh its `position`, `normal`, `triangle` and `light`, as in the request.
"""

import sys

import numpy as np

_VERTEX_DEC = """//VTK::Normal::Dec
in vec3 outward;
in vec3 tint;
in vec2 light;
out vec3 place;
out vec3 outwardOut;
out vec3 tintOut;
out vec2 lightOut;
"""
_VERTEX_IMPL = """//VTK::Normal::Impl
place = vertexMC.xyz;
outwardOut = outward;
tintOut = tint;
lightOut = light;
"""
_FRAGMENT_DEC = """//VTK::Normal::Dec
in vec3 place;
in vec3 outwardOut;
in vec3 tintOut;
in vec2 lightOut;
vec3 decoded(vec3 c) { return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), step(0.04045, c)); }
vec3 encoded(vec3 c) { c = clamp(c, 0.0, 1.0); return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c)); }
vec3 shouldered(vec3 c) { return c * (1.0 + 0.10 * c) / (1.0 + 0.62 * c); }
"""
_SURFACE = """
vec4 texel = texture(surfaceAlbedo, tcoordVCVSOutput);
if (texel.a < cutoff) discard;
vec3 base = decoded(texel.rgb) * tintOut;
vec3 q0 = dFdx(place), q1 = dFdy(place);
vec2 s0 = dFdx(tcoordVCVSOutput), s1 = dFdy(tcoordVCVSOutput);
vec3 n = normalize(gl_FrontFacing ? outwardOut : -outwardOut);
vec3 t = q0 * s1.y - q1 * s0.y;
vec3 b = -q0 * s1.x + q1 * s0.x;
float turn = sign(s0.x * s1.y - s1.x * s0.y);
vec3 m = texture(surfaceNormal, tcoordVCVSOutput).xyz * 2.0 - 1.0;
if (dot(t, t) > 0.0 && dot(b, b) > 0.0)
  n = normalize(normalize(t) * turn * m.x + normalize(b) * turn * m.y + n * m.z);
vec3 eye = normalize(viewer - place);
float facing = dot(n, sun_side);
float front = max(facing, 0.0) * (1.0 - 0.22 * leaf);
float through = leaf * max(-facing, 0.0);
vec3 half_way = normalize(sun_side + eye);
float gleam = gloss * pow(max(dot(n, half_way), 0.0), 28.0) * max(facing, 0.0);
float up = 0.5 + 0.5 * n.y;
vec3 sun = vec3(2.30, 2.12, 1.80) * lightOut.x;
vec3 sky = mix(vec3(0.33, 0.32, 0.28), vec3(0.66, 0.76, 0.90), mix(up, 0.6, leaf * 0.5)) * (0.16 + 0.84 * lightOut.y) * (1.0 - 0.18 * leaf);
float rim = pow(1.0 - abs(dot(n, eye)), 3.0) * 0.10 * lightOut.y * (1.0 - leaf);
vec3 colour = base * (sun * front + sky) + base * vec3(1.15, 1.20, 0.55) * sun * 0.38 * through + sun * gleam + vec3(rim);
gl_FragData[0] = vec4(encoded(shouldered(1.18 * colour)), 1.0);
"""
_GROUND = """
vec3 lit = decoded(texture(surfaceAlbedo, tcoordVCVSOutput).rgb);
vec2 from = (tcoordVCVSOutput - 0.5) * 2.0;
float fade = 1.0 - smoothstep(0.30, 0.98, length(from));
vec3 back = mix(horizon, zenith, gl_FragCoord.y / picture_height);
vec3 own = mix(back, earth, 0.45 * fade);
gl_FragData[0] = vec4(own * mix(1.0, encoded(lit).r, fade), 1.0);
"""


def main(request_path: str, png_path: str) -> None:
    """Draw the request's pictures and join them into one PNG."""
    from PIL import Image

    with np.load(request_path) as file:
        request = dict(file)
    if png_path in ("window", "film"):
        {"window": _window, "film": _film}[png_path](request)
        return
    width, height = (int(n) for n in request["size"])
    scale = int(request["supersample"])
    plotter, shaders, _ = _stage(request, (scale * width, scale * height))
    pictures = []
    for camera in request["camera"]:
        _aim(plotter, shaders, camera, request["sun"])
        if "parallel" in request:
            plotter.camera.parallel_projection, plotter.camera.parallel_scale = True, float(request["parallel"]) / 2
            plotter.reset_camera_clipping_range()
        pictures.append(_taken(plotter, scale))
    columns = int(request["columns"])
    rows = -(-len(pictures) // columns)
    sheet = Image.new("RGB", (columns * width, rows * height), "white")
    for k, picture in enumerate(pictures):
        sheet.paste(picture, ((k % columns) * width, (k // columns) * height))
    sheet.save(png_path, format="PNG")


def _taken(plotter, scale: int):
    """The picture, so many times smaller than it is drawn."""
    from PIL import Image

    plotter.render()
    picture = Image.fromarray(plotter.screenshot(None, return_img=True)[..., :3])
    return picture.reduce(scale) if scale > 1 else picture


def _film(request) -> None:
    """A picture for every line that is read."""
    scale = int(request["supersample"])
    plotter, shaders, actors = _stage(request, tuple(scale * int(n) for n in request["size"]))
    for actor in actors:  # of a sliver such as a rim that has just begun to part, Mesa's anisotropic filter takes half a minute
        for name in ("surfaceAlbedo", "surfaceNormal"):
            if texture := actor.GetProperty().GetTexture(name):
                texture.SetMaximumAnisotropicFiltering(1)
    for line in sys.stdin:
        changes_path, png_path = line.rstrip("\n").split("\t")
        with np.load(changes_path) as file:
            changes = dict(file)
        for k in range(int(request["meshes"])):
            _move(actors[k], {name.split(".", 1)[1]: value for name, value in changes.items() if name.startswith(f"{k}.")})
        if "ground" in changes:
            actors[-1].GetProperty().RemoveTexture("surfaceAlbedo")
            actors[-1].GetProperty().SetTexture("surfaceAlbedo", _texture(changes["ground"], repeat=False))
        _aim(plotter, shaders, changes["camera"], request["sun"])
        _taken(plotter, scale).save(png_path, format="PNG", compress_level=1)
        print(line, end="", flush=True)


def _move(actor, part: dict) -> None:
    """The mesh of an actor with other places, normals, light and triangles."""
    if not part:
        return
    actor.SetVisibility(bool(len(part["triangle"])))
    if len(part["triangle"]):
        mesh = actor.GetMapper().GetInput()
        mesh.points = part["position"]
        mesh.faces = _faces(part["triangle"])
        mesh.point_data["outward"], mesh.point_data["light"] = part["normal"], part["light"]


def _window(request) -> None:
    """A window to turn the tree in; ends when it is closed (or `q` is pressed)."""
    plotter, shaders, _ = _stage(request, tuple(int(n) for n in request["size"]), window=True)
    _aim(plotter, shaders, request["camera"][0], request["sun"])
    plotter.renderer.AddObserver("StartEvent", lambda *_: _look(plotter, shaders))
    plotter.enable_terrain_style(mouse_wheel_zooms=True)
    plotter.show(title=str(request["title"]), auto_close=True)


def _look(plotter, shaders) -> None:
    """Tell the shaders where the camera has been turned to."""
    for shader in shaders:
        shader.GetFragmentCustomUniforms().SetUniform3f("viewer", [float(x) for x in plotter.camera.position])


def _stage(request, size, *, window: bool = False):
    """A plotter with every mesh and, last, the ground, lit by our own shaders; the shaders' properties, and the actors."""
    import pyvista

    pyvista.OFF_SCREEN = not window
    plotter = pyvista.Plotter(off_screen=not window, window_size=size, lighting="none")
    plotter.render_window.SetMultiSamples(4 if window else 0)
    horizon, zenith, earth = request["horizon"], request["zenith"], request["earth"]
    plotter.set_background(tuple(horizon), top=tuple(zenith))
    shaders, actors = [], []
    for k in range(int(request["meshes"])):
        part = {name.split(".", 1)[1]: value for name, value in request.items() if name.startswith(f"{k}.")}
        cutoff, leaf, gloss = (float(value) for value in part["look"])
        textures = {"surfaceAlbedo": part["albedo"], "surfaceNormal": part["normal_map"]}
        shader, actor = _add(plotter, part, textures, _SURFACE, repeat=not leaf)
        actors.append(actor)
        for name, value in (("cutoff", cutoff), ("leaf", leaf), ("gloss", gloss)):
            shader.GetFragmentCustomUniforms().SetUniformf(name, value)
        shaders.append(shader)
    if "ground" in request:
        shader, actor = _add(plotter, _disc(float(request["reach"])), {"surfaceAlbedo": request["ground"]}, _GROUND, repeat=False)
        uniforms = shader.GetFragmentCustomUniforms()
        uniforms.SetUniformf("picture_height", float(size[1]))
        for name, colour in (("horizon", horizon), ("zenith", zenith), ("earth", earth)):
            uniforms.SetUniform3f(name, [float(c) for c in colour])
        shaders.append(shader)
        actors.append(actor)
    return plotter, shaders, actors


def _add(plotter, part, textures, fragment, *, repeat):
    """One mesh as an actor whose colour is `fragment`'s; returns its shader property and the actor."""
    import pyvista
    from vtkmodules.vtkCommonDataModel import vtkDataObject
    from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

    mesh = pyvista.PolyData(part["position"], _faces(part["triangle"]))
    mesh.active_texture_coordinates = np.column_stack([part["uv"][:, 0], 1 - part["uv"][:, 1]]).astype(np.float32)
    for name, column in (("outward", "normal"), ("tint", "tint"), ("light", "light")):
        mesh.point_data[name] = part[column]
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(mesh)
    mapper.ScalarVisibilityOff()
    mapper.SetVBOShiftScaleMethod(0)
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.ForceOpaqueOn()
    for name, pixels in textures.items():
        actor.GetProperty().SetTexture(name, _texture(pixels, repeat=repeat))
    for name in ("outward", "tint", "light"):
        mapper.MapDataArrayToVertexAttribute(name, name, vtkDataObject.FIELD_ASSOCIATION_POINTS, -1)
    shader = actor.GetShaderProperty()
    shader.AddVertexShaderReplacement("//VTK::Normal::Dec", True, _VERTEX_DEC, False)
    shader.AddVertexShaderReplacement("//VTK::Normal::Impl", True, _VERTEX_IMPL, False)
    shader.AddFragmentShaderReplacement("//VTK::Normal::Dec", True, _FRAGMENT_DEC, False)
    shader.AddFragmentShaderReplacement("//VTK::TCoord::Impl", True, fragment, False)
    plotter.add_actor(actor, reset_camera=False, render=False)
    return shader, actor


def _faces(triangle):
    """Triangles as VTK counts them: 3, a, b, c, 3 …"""
    return np.column_stack([np.full(len(triangle), 3), triangle]).ravel()


def _texture(pixels, *, repeat: bool):
    import pyvista

    texture = pyvista.Texture(np.ascontiguousarray(pixels))
    texture.repeat, texture.interpolate, texture.mipmap = repeat, True, repeat
    return texture


def _disc(reach: float) -> dict:
    """The ground as a square with its texture's edges at ±reach; rows of the texture run along +z."""
    corner = np.array([[-1, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1]], np.float32)
    return {
        "position": corner * reach,
        "normal": np.tile(np.array([0, 1, 0], np.float32), (4, 1)),
        "uv": (corner[:, [0, 2]] + 1) / 2,
        "triangle": np.array([[0, 2, 1], [0, 3, 2]]),
        "tint": np.ones((4, 3), np.float32),
        "light": np.ones((4, 2), np.float32),
    }


def _aim(plotter, shaders, camera, sun) -> None:
    """Point the camera (eye, target, up, field of view in degrees) and tell the shaders where the sun is."""
    eye, target, up, field = camera[:3], camera[3:6], camera[6:9], float(camera[9])
    plotter.camera.position, plotter.camera.focal_point, plotter.camera.up = tuple(eye), tuple(target), tuple(up)
    plotter.camera.view_angle = field
    plotter.reset_camera_clipping_range()
    for shader in shaders:
        uniforms = shader.GetFragmentCustomUniforms()
        uniforms.SetUniform3f("sun_side", [float(x) for x in sun])
        uniforms.SetUniform3f("viewer", [float(x) for x in eye])


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2])
