"""How does a page with strokes on it lie over a picture? As large as that, once it is scaled: both have one shape."""

import numpy as np
from jaxtyping import Float

SAME_SHAPE = 0.01  # by which the page's width / height may differ from the picture's


def page_over(page: tuple[float, float, float, float] | None, width: int, height: int) -> tuple[float, Float[np.ndarray, " 2"]] | None:
    """(pixels a user unit, shift) from a page (left, bottom, right, top; y up) to a picture of so many pixels (y down): points · (1, −1) · scale + shift. Without a page the units are pixels;
    None where the page has another shape."""
    if page is None:
        return 1.0, np.zeros(2)
    left, bottom, right, top = page
    wide, high = right - left, top - bottom
    if wide <= 0 or high <= 0 or abs(wide / high * height / width - 1) > SAME_SHAPE:
        return None
    return width / wide, np.array([-left, top]) * (width / wide)
