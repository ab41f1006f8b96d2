"""A matte in, a trunk out (§II.2-3 of the single-image growth paper): where does each limb run in the picture, how thick is it, and how might it stand in space?

    binary      which pixels are the trunk?                  alpha → one piece
    drained     which of it is limb, which twigs?            by what runs through it to the ground
    outline     where does it end?                           → polygons between pixels
    evolution   which of their vertices tell the shape?      discrete curve evolution; noise: how far?   edits: what does a person change?
    segments    into which parts do they cut the contour?    → medial: the axis that no part alone gives rise to
    rooted      which way does it grow?                      blunt: which branches are corners?   ends: where does a limb end?
    limb_lines  how does each limb run?                      straight past its limbs, each from its bearer's axis
    skeletonise all of it in order                           → TrunkSkeleton
    edit_matte  what was painted out or in?
    limbs, borne                                             which branch goes on, how thick is it?
    around, siblings → as_tree                               → TreeSkeleton, its projection that of the picture
"""
