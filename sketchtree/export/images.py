"""Textures as the bytes of an image file."""

import io
from collections import OrderedDict
from hashlib import blake2b

import numpy as np
from jaxtyping import UInt8
from PIL import Image

_JPEG_QUALITY = 90
_KEPT = 64
_cache: OrderedDict[tuple[bytes, bool], tuple[bytes, str]] = OrderedDict()


def encode(image: UInt8[np.ndarray, "row column *channel"], *, photographic: bool = False) -> tuple[bytes, str]:
    """The bytes of the image and their media type: JPEG where it is `photographic` and has no alpha, else PNG.

    The same pixels give the same bytes. Textures are few and used again, so the last ones are kept.
    """
    image = np.ascontiguousarray(image, np.uint8)
    jpeg = photographic and not (image.ndim == 3 and image.shape[2] == 4)
    digest = blake2b(image.tobytes() + repr(image.shape).encode(), digest_size=16).digest()
    if (digest, jpeg) not in _cache:
        _cache[digest, jpeg] = _encode(image, jpeg)
        while len(_cache) > _KEPT:
            _cache.popitem(last=False)
    return _cache[digest, jpeg]


def _encode(image, jpeg: bool) -> tuple[bytes, str]:
    file = io.BytesIO()
    if jpeg:
        Image.fromarray(image).save(file, "JPEG", quality=_JPEG_QUALITY, subsampling=0)
        return file.getvalue(), "image/jpeg"
    Image.fromarray(image).save(file, "PNG", compress_level=6)
    return file.getvalue(), "image/png"
