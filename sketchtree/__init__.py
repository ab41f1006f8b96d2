"""Freehand strokes in, a complete textured 3D tree out.

The public names, in the order of the pipeline; each is imported when it is first used.

    read_sketch → Sketch                 what was drawn
    sketch_graph → SketchGraph           strokes → one rooted segment tree
    Database, match                      which exemplar is it most like?
    Prior, factor_graph, infer, lift     how deep is each segment? → TreeSkeleton
    Propagate                            what did the sketch leave out?
    PipeRadii, wood_mesh                 what shape is the wood?
    populate, blossom, leaf_mesh         which leaves, and where?
    write_glb, write_swc, preview        files and pictures
    sketch_to_tree                       all of it in one call → TreeModel
    sketches_to_forest                   several, grown together → Forest
    read_photo, read_strokes             a photo, and what is marked in it → Photo, (Marked, …)
    photo_to_tree                        one photo and a few strokes in one call → PhotoModel
    Attract                              a tree grows to where foliage was seen
    draw                                 a page to draw on in a cell of a notebook → DrawingWidget
"""

from importlib import import_module

from sketchtree.version import __version__

_HOMES = {
    "sketchtree.keys": ("root_key", "stage_key"),
    "sketchtree.sketch.strokes": ("Sketch", "Stroke", "StrokeKind"),
    "sketchtree.sketch.formats": ("read_sketch", "write_sketch", "write_sketch_json"),
    "sketchtree.sketch.graph": ("SketchGraph",),
    "sketchtree.sketch.reading": ("sketch_graph",),
    "sketchtree.parameters": ("TreeParameters", "LimbStatistics", "Habit"),
    "sketchtree.templates.store.database": ("Database",),
    "sketchtree.templates.matching.match": ("match",),
    "sketchtree.mrf.prior": ("Prior",),
    "sketchtree.mrf.factor_graph": ("factor_graph",),
    "sketchtree.mrf.methods": ("METHODS", "solver_named"),
    "sketchtree.mrf.infer": ("infer", "refine"),
    "sketchtree.mrf.elevation": ("Elevation",),
    "sketchtree.mrf.explain": ("explain",),
    "sketchtree.mrf.lift": ("lift",),
    "sketchtree.similarity": ("Similarity",),
    "sketchtree.skeleton": ("TreeSkeleton", "Kind"),
    "sketchtree.skeleton_files": ("read_skeleton", "read_swc", "read_skeleton_json"),
    "sketchtree.stage": ("SkeletonSource", "SkeletonStage", "sources", "stages"),
    "sketchtree.propagate.generations": ("Propagate",),
    "sketchtree.geometry.radii": ("PipeRadii",),
    "sketchtree.geometry.wood": ("wood_mesh", "wood_meshes"),
    "sketchtree.geometry.mesh": ("Mesh", "Material"),
    "sketchtree.foliage.populate": ("populate",),
    "sketchtree.foliage.blossom": ("blossom",),
    "sketchtree.foliage.cards": ("leaf_mesh",),
    "sketchtree.foliage.instanced": ("leaf_instances",),
    "sketchtree.foliage.leaf_cards": ("leaf_cards",),
    "sketchtree.export.gltf": ("write_glb",),
    "sketchtree.export.skeletons": ("write_swc", "write_skeleton_json"),
    "sketchtree.view": ("preview",),
    "sketchtree.options": ("ReadingOptions", "TreeOptions"),
    "sketchtree.pipeline": ("sketch_to_tree", "draw_out", "complete", "TreeModel"),
    "sketchtree.forest": ("sketches_to_forest", "Forest"),
    "sketchtree.photo.photo": ("Photo",),
    "sketchtree.photo.marked": ("Marked",),
    "sketchtree.photo.read_photo": ("read_photo", "as_photo"),
    "sketchtree.photo.read_strokes": ("read_strokes",),
    "sketchtree.photo.auto.propose": ("propose",),
    "sketchtree.photo.wanted": ("PhotoOptions",),
    "sketchtree.photo_tree": ("photo_to_tree", "PhotoModel", "PhotoTree", "PhotoSource"),
    "sketchtree.propagate.attractors.stage": ("Attract",),
    "sketchtree.propagate.attractors.target": ("Target",),
    "sketchtree.studio.widget": ("draw", "DrawingWidget"),
    "sketchtree.errors": ("SketchTreeError", "SketchError", "SkeletonError", "TemplateError", "ExportError"),
}
_HOME_OF = {name: module for module, names in _HOMES.items() for name in names}

__all__ = ["__version__", *_HOME_OF]


def __getattr__(name: str):
    if name not in _HOME_OF:
        raise AttributeError(f"module `sketchtree` has no attribute `{name}`")
    value = getattr(import_module(_HOME_OF[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)
