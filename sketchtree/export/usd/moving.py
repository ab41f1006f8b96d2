"""How do a tree's joints and morphs move in USD? A SkelAnimation with time samples, and a BlendShape for each morph.

Times are counted in time codes, `PER_SECOND` a second. The extent of the whole, which a skeleton moves, is sampled too: the box that holds every joint's box
of what it moves.
"""

from collections.abc import Sequence

import numpy as np
from pxr import Gf, UsdGeom, UsdSkel, Vt

from sketchtree.asset import Animation, Armature, Asset, Keys, Morph
from sketchtree.export.pose import inverse_bind, local_pose
from sketchtree.export.usd.names import prim_name
from sketchtree.export.usd.sampled import PER_SECOND, Sampled, sample_times, sampled
from sketchtree.geometry.instances import Instances
from sketchtree.geometry.mesh import Mesh

_SAME = 1e-6  # a column that differs less from rest is at rest
_HALF = 65504.0  # the greatest number of half precision


def define_animation(stage, skeleton, asset: Asset, names: dict[int, str]) -> None:
    """The animation of the skeleton (its path); `names` is the path of each part of the finest level that has a morph."""
    animation, bones = asset.animation, asset.armature
    made = UsdSkel.Animation.Define(stage, f"{skeleton}/{prim_name(animation.name, set())}")
    prim = stage.GetPrimAtPath(skeleton)
    made.CreateJointsAttr(UsdSkel.Skeleton(prim).GetJointsAttr().Get())
    corners, still = _boxes(asset)
    moves = sampled(bones, animation, np.isfinite(corners).all(axis=(1, 2)))
    _set(made.CreateTranslationsAttr(), moves.time, moves.translation, lambda rows: Vt.Vec3fArray.FromNumpy(np.ascontiguousarray(rows, np.float32)))
    _set(made.CreateRotationsAttr(), moves.time, moves.rotation, _quaternions)
    _set(made.CreateScalesAttr(), moves.time, np.clip(moves.scale, -_HALF, _HALF), lambda rows: Vt.Vec3hArray.FromNumpy(np.ascontiguousarray(rows, np.float16)))
    _define_morphs(stage, made, asset, names)
    UsdSkel.BindingAPI.Apply(prim).CreateAnimationSourceRel().SetTargets([made.GetPath()])
    stage.SetTimeCodesPerSecond(PER_SECOND)
    stage.SetFramesPerSecond(PER_SECOND)
    stage.SetStartTimeCode(0.0)
    stage.SetEndTimeCode(animation.seconds * PER_SECOND)
    _set_extents(UsdGeom.Boundable(stage.GetDefaultPrim()), asset, moves, corners, still)


def read_animation(stage, bones: Armature, parts: Sequence) -> Animation | None:
    """How the first skeleton moves; `parts` are the prims of the finest level's parts. None: it doesn't."""
    skeleton = next(prim for prim in stage.Traverse() if prim.IsA(UsdSkel.Skeleton))
    query = UsdSkel.Cache().GetSkelQuery(UsdSkel.Skeleton(skeleton)).GetAnimQuery()
    if not query:
        return None
    made = UsdSkel.Animation(query.GetPrim())
    rate = stage.GetTimeCodesPerSecond()
    order = list(made.GetJointsAttr().Get() or [])
    place = {path: number for number, path in enumerate(UsdSkel.Skeleton(skeleton).GetJointsAttr().Get())}
    joint = np.array([place.get(path, -1) for path in order], int)
    rotation, translation = local_pose(bones)
    columns = (made.GetTranslationsAttr(), translation), (made.GetRotationsAttr(), rotation), (made.GetScalesAttr(), np.ones_like(translation))
    keys = [_keys(attribute, rest, joint, rate) for attribute, rest in columns]
    morphs = _read_morphs(made, parts, rate)
    if not any(map(len, keys)) and not morphs:
        return None
    last = max([float(one.time.max(initial=0.0)) for one in keys] + [float(morph.time[-1]) for morph in morphs] + [stage.GetEndTimeCode() / rate])
    return Animation(query.GetPrim().GetName(), last, *keys, morphs=morphs)


def _set(attribute, time, values, packed) -> None:
    """A value for all times where nothing moves, else one a time."""
    if np.ptp(values, axis=0).max(initial=0.0) == 0:
        attribute.Set(packed(values[0]))
        return
    for second, rows in zip(time.tolist(), values, strict=True):
        attribute.Set(packed(rows), second * PER_SECOND)


def _quaternions(rows):
    return Vt.QuatfArray([Gf.Quatf(w, x, y, z) for x, y, z, w in rows.tolist()])


def _define_morphs(stage, made, asset: Asset, names: dict[int, str]) -> None:
    morphs = [morph for morph in asset.animation.morphs if morph.part in names]
    if not morphs:
        return
    words = []
    for number, morph in enumerate(morphs):
        words.append(f"morph_{number + 1}")
        mesh = stage.GetPrimAtPath(names[morph.part])
        shape = UsdSkel.BlendShape.Define(stage, f"{names[morph.part]}/{words[-1]}")
        shape.CreateOffsetsAttr(Vt.Vec3fArray.FromNumpy(np.ascontiguousarray(morph.offset, np.float32)))
        shape.CreateNormalOffsetsAttr(Vt.Vec3fArray.FromNumpy(np.zeros(morph.offset.shape, np.float32)))
        binding = UsdSkel.BindingAPI.Apply(mesh)
        binding.CreateBlendShapesAttr([words[-1]])
        binding.CreateBlendShapeTargetsRel().SetTargets([shape.GetPath()])
    made.CreateBlendShapesAttr(words)
    weights = made.CreateBlendShapeWeightsAttr()
    time = sample_times(asset.animation.seconds, [morph.time for morph in morphs])
    values = np.stack([np.interp(time, morph.time, morph.weight) for morph in morphs], axis=1)
    _set(weights, time, values, lambda row: Vt.FloatArray.FromNumpy(np.ascontiguousarray(row, np.float32)))


def _set_extents(root, asset: Asset, moves: Sampled, corners, still) -> None:
    """The box of all that is drawn, at rest and at each time."""
    held = np.isfinite(corners).all(axis=(1, 2))
    attribute = root.CreateExtentAttr()
    whole = [place for part in asset.parts for place in [_places(part)] if len(place)]
    if not whole:
        return
    attribute.Set(_box(np.vstack(whole)))
    for k, second in enumerate(moves.time.tolist()):
        frame = moves.frames(asset.armature, k)[held]
        moved = np.einsum("jab,jcb->jca", frame[:, :3, :3], corners[held]) + frame[:, None, :3, 3]
        attribute.Set(_box(np.vstack([moved.reshape(-1, 3), *still])), second * PER_SECOND)


def _boxes(asset: Asset):
    """(corners of the box, in its own frame, of what each joint moves, [joint 8 3], infinite where it moves nothing; places that nothing moves)."""
    to_joint = inverse_bind(asset.armature)
    low, high = np.full((len(to_joint), 3), np.inf), np.full((len(to_joint), 3), -np.inf)
    still = []
    morphs = {morph.part: morph.offset for morph in asset.animation.morphs}
    for number, part in enumerate(asset.parts):
        if isinstance(part, Instances) or "JOINTS_0" not in part.extra:
            still.append(_places(part))
            continue
        for place in (part.position, part.position + morphs[number]) if number in morphs else (part.position,):
            for joint, weight in zip(np.asarray(part.extra["JOINTS_0"]).T, np.asarray(part.extra["WEIGHTS_0"]).T, strict=True):
                of = joint[weight > 0].astype(np.int64)
                own = np.einsum("vab,vb->va", to_joint[of, :3, :3], place[weight > 0]) + to_joint[of, :3, 3]
                np.minimum.at(low, of, own)
                np.maximum.at(high, of, own)
    pick = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], bool)
    return np.where(pick[None], high[:, None], low[:, None]), [places for places in still if len(places)]


def _places(part: Mesh | Instances):
    mesh = part.merged()
    return mesh.position[np.unique(mesh.triangle)]


def _box(points):
    return Vt.Vec3fArray.FromNumpy(np.stack([points.min(axis=0), points.max(axis=0)]).astype(np.float32))


def _keys(attribute, rest, joint, rate: float) -> Keys:
    """A track for each joint that is ever elsewhere than at rest."""
    times = attribute.GetTimeSamples() or [0.0]
    values = np.stack([_rows(attribute.Get(time), rest.shape[1]) for time in times]) if len(joint) and attribute.Get(times[0]) else np.zeros((0, 0, 0))
    if values.size == 0:
        return Keys(np.zeros(0, np.int64), np.zeros(1, np.int64), np.zeros(0), np.zeros((0, rest.shape[1])))
    off = np.abs(values - rest[np.maximum(joint, 0)]).max(axis=(0, 2))
    moved = np.flatnonzero((joint >= 0) & (off > _SAME))
    time = np.tile(np.array(times) / rate, len(moved))
    return Keys(joint[moved], len(times) * np.arange(len(moved) + 1), time, values[:, moved].transpose(1, 0, 2).reshape(-1, rest.shape[1]))


def _rows(value, width: int):
    if width == 4:
        return np.array([[*q.GetImaginary(), q.GetReal()] for q in value], float)
    return np.array(value, float)


def _read_morphs(made, parts: Sequence, rate: float) -> tuple[Morph, ...]:
    words, weights = list(made.GetBlendShapesAttr().Get() or []), made.GetBlendShapeWeightsAttr()
    times = weights.GetTimeSamples() or [0.0]
    if not words or weights.Get(times[0]) is None:
        return ()
    values = np.array([np.array(weights.Get(time), float) for time in times])
    found = []
    for number, prim in enumerate(parts):
        binding = UsdSkel.BindingAPI(prim)
        if not prim.HasAPI(UsdSkel.BindingAPI) or not binding.GetBlendShapesAttr().Get():
            continue
        name, target = binding.GetBlendShapesAttr().Get()[0], binding.GetBlendShapeTargetsRel().GetTargets()[0]
        if name in words:
            offset = np.array(UsdSkel.BlendShape.Get(prim.GetStage(), target).GetOffsetsAttr().Get(), float).reshape(-1, 3)
            found.append(Morph(number, offset, np.array(times) / rate, values[:, words.index(name)]))
    return tuple(found)
