"""Textures as the bytes of an image file.

Colours and normals are JPEG without chroma subsampling, at a quality at which no block shows (of the barks' normals 93 keeps the mean
error below 2°, at 40 % of a PNG's bytes); whatever has alpha is PNG.
"""

import io
from collections import OrderedDict
from hashlib import blake2b

import numpy as np
from jaxtyping import UInt8
from PIL import Image

COLOR, NORMAL = 90, 93  # JPEG qualities
_KEPT = 64
_cache: OrderedDict[tuple[bytes, int | None], tuple[bytes, str]] = OrderedDict()


def encode(image: UInt8[np.ndarray, "row column *channel"], quality: int | None = None) -> tuple[bytes, str]:
    """The bytes of the image and their media type: JPEG of that quality (`COLOR`, `NORMAL`) where it has no alpha, else PNG.

    The same pixels give the same bytes. Textures are few and used again, so the last ones are kept.
    """
    image = np.ascontiguousarray(image, np.uint8)
    quality = None if image.ndim == 3 and image.shape[2] == 4 else quality
    digest = blake2b(image.tobytes() + repr(image.shape).encode(), digest_size=16).digest()
    if (digest, quality) not in _cache:
        _cache[digest, quality] = _encode(image, quality)
        while len(_cache) > _KEPT:
            _cache.popitem(last=False)
    return _cache[digest, quality]


def ending(media: str) -> str:
    """How the name of such a file ends, with the dot."""
    return {"image/jpeg": ".jpg", "image/png": ".png"}[media]


def decode(data: bytes, mode: str) -> UInt8[np.ndarray, "row column *channel"]:
    """The pixels of an image file, in PIL's `mode` (RGB, RGBA, L)."""
    return np.asarray(Image.open(io.BytesIO(data)).convert(mode))


def _encode(image, quality: int | None) -> tuple[bytes, str]:
    file = io.BytesIO()
    if quality is not None:
        Image.fromarray(image).save(file, "JPEG", quality=quality, subsampling=0, optimize=True)
        return file.getvalue(), "image/jpeg"
    Image.fromarray(image).save(file, "PNG", compress_level=6)
    return file.getvalue(), "image/png"
