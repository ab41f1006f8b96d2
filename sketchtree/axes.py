"""Names of the axes of the project's arrays, as they stand in the jaxtyping annotations.

    stroke      one freehand line of the drawing
    segment     one row of a skeleton or of a sketch graph (bases included)
    limb        one chain of segments from its insertion to its tip
    point       one vertex of a polyline; ragged columns of points are cut by `*_start`
    pair        a segment and its parent
    view        one azimuth from which an exemplar was projected
    direction   one of the K_f directions of a footprint
    exemplar    one tree of the template database
    order       branching order (0 the trunk)
    leaf        one leaf or needle tuft
    vertex      one vertex of a mesh;  triangle: one face of it
    chain       one Markov chain;  sample: one kept state of the chains

Frames: right-handed, x right, y up, z towards the viewer. World lengths are metres; a sketch's are
the user units of its file, with y already negated so that it points up. Angles are radians in code
and degrees in recipes, reports and on the command line.
"""

NULL = -1  # "none" in every index column
