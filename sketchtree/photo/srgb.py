"""What colours does a picture show? Those of its embedded profile, turned to sRGB: a wide-gamut phone photo, a CMYK scan, CIELAB.

A profile that can't be used is passed by, with a warning; a picture without one is sRGB already, or CMYK by the plain rule of its inks.
"""

import io

import numpy as np
from jaxtyping import UInt8
from PIL import Image, ImageCms

from sketchtree.sketch.raster.opening import plain


def in_srgb(image: Image.Image) -> tuple[UInt8[np.ndarray, "row column 3"], UInt8[np.ndarray, "row column"] | None, tuple[str, ...]]:
    """(colours on white, alpha or None where it is full everywhere, warnings) of an opened picture."""
    profile = image.info.get("icc_profile")
    alpha = None
    if image.mode not in ("CMYK", "LAB"):
        image = plain(image)
        if image.mode in ("LA", "RGBA"):
            alpha = np.array(image.getchannel("A"))
            image = image.convert(image.mode[:-1])
        if image.mode == "F":
            image = Image.fromarray(np.clip(np.rint(np.asarray(image)), 0, 255).astype(np.uint8))
    image, warnings = _by_profile(image, profile)
    rgb = np.array(image.convert("RGB"))
    if alpha is None or alpha.min() == 255:
        return rgb, None, warnings
    cover = alpha[..., None].astype(np.float32) / 255
    return np.rint(rgb * cover + 255 * (1 - cover)).astype(np.uint8), alpha, warnings


def _by_profile(image: Image.Image, profile: bytes | None) -> tuple[Image.Image, tuple[str, ...]]:
    """The picture by its profile; a grey one stays grey."""
    srgb = ImageCms.createProfile("sRGB")
    if profile is None:
        return (ImageCms.profileToProfile(image, ImageCms.createProfile("LAB"), srgb, outputMode="RGB"), ()) if image.mode == "LAB" else (image, ())
    try:
        found = ImageCms.profileToProfile(image, ImageCms.ImageCmsProfile(io.BytesIO(profile)), srgb, outputMode="RGB")
    except (ImageCms.PyCMSError, OSError, ValueError):
        return image, ("its colour profile can't be used; its colours were taken for sRGB.",)
    if image.mode == "L":
        return found.getchannel("G"), ()
    return found, ()
