"""What does the photo print on leaves that bear its own picture (Tan et al. 2008, §4: "Leaves are textured according to their projected position on the input image")?

The photo where its foliage is, cut out, no longer than LONGEST pixels. Pixels that show no leaf take the nearest that does, lest a leaf be half sky; half of the photo's shadows are
taken out, as of leaves in one colour (`photo_leaves.without_shadows`).
"""

import numpy as np
from PIL import Image
from scipy import ndimage

from sketchtree.foliage.painting import to_linear, to_srgb
from sketchtree.foliage.printed import Print
from sketchtree.photo.photo_leaves import SeenFoliage, box_of, without_shadows

LONGEST = 1024  # pixels


def leaf_print(seen: SeenFoliage) -> Print | None:
    """The picture, where it hangs in the world; None if no pixel shows a leaf."""
    leafy = seen.mask if seen.leafy is None else seen.leafy
    if not leafy.any():
        return None
    box = rows, columns = box_of(seen.mask)
    rgb, shown = seen.photo.rgb[box], leafy[box]
    nearest = ndimage.distance_transform_edt(~shown, return_distances=False, return_indices=True)
    filled = rgb[tuple(nearest)]
    step = -(-max(shown.shape) // LONGEST)
    image = Image.fromarray(filled)
    picture = np.asarray(image.reduce(step) if step > 1 else image)
    lit = without_shadows(to_linear(np.arange(256) / 255.0)[picture].reshape(-1, 3))
    printed = np.round(255 * to_srgb(lit)).astype(np.uint8).reshape(picture.shape)
    left, top = seen.similarity.to_world(np.array([[columns.start, -float(rows.start)]]))[0]
    return Print(printed, float(left), float(top), seen.similarity.scale * step)
