"""A file, or a sketch, becomes the branches it shows: the first stage of every command."""

from pathlib import Path

from sketchtree.options import DrawingOptions
from sketchtree.sketch.formats import read_sketch
from sketchtree.sketch.graph import SketchGraph
from sketchtree.sketch.reading import sketch_graph
from sketchtree.sketch.strokes import Sketch
from sketchtree.watch import Watch, shared

_FILE = 0.5  # of the work, about: the file's own part of reading a large drawing


def read_drawing(source: Sketch | str | Path, options: DrawingOptions, watch: Watch) -> tuple[Sketch, SketchGraph]:
    """(the drawing, its segment tree). Raises SketchError."""
    if isinstance(source, Sketch):
        return source, sketch_graph(source, crown=options.crown)
    sketch = read_sketch(
        source,
        max_strokes=options.max_strokes,
        max_mb=options.max_mb,
        max_megapixels=options.max_megapixels,
        progress=shared(watch.on_part, 0.0, _FILE),
    )
    return sketch, sketch_graph(sketch, crown=options.crown)
