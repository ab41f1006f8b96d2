"""What kind of point cloud is this? By what it holds; its name is not asked. Formats that are known but not read are named, with the way to one that is."""

from sketchtree.clouds.files.refused import AGAIN, CONVERT, GIVE
from sketchtree.errors import SketchError

PLY, LAS, NPY, NPZ, TEXT = "PLY", "LAS", "NPY", "NPZ", "text"
HEAD = 4096  # bytes that are looked at
_OURS = {b"ply": PLY, b"LASF": LAS, b"\x93NUMPY": NPY, b"PK\x03\x04": NPZ}
_UNPACK = "Unpack it, and give the cloud inside."
_SAVE = "Save it as PLY."
_PLAIN = "Save it as plain text (UTF-8)."
_VIEWS = "Give a folder of photos to `sketchtree views`."
_OTHERS = {
    b"ASTM-E57": ("an E57 scan", CONVERT),
    b"# .PCD": ("a PCD cloud", CONVERT),
    b"VERSION": ("a PCD cloud", CONVERT),
    b"glTF": ("a finished 3D model", CONVERT),
    b"OFF": ("an OFF mesh", _SAVE),
    b"solid": ("an STL mesh", _SAVE),
    b"v ": ("an OBJ mesh", _SAVE),
    b"mtllib": ("an OBJ mesh", _SAVE),
    b"CCB2": ("a CloudCompare project", "Save the cloud from CloudCompare as LAZ or PLY."),
    b"Potree": ("a Potree cloud", CONVERT),
    b"\x89HDF": ("an HDF5 file", CONVERT),
    b"\x1f\x8b": ("a gzip archive", _UNPACK),
    b"7z\xbc\xaf": ("an archive", _UNPACK),
    b"Rar!": ("an archive", _UNPACK),
    b"\x89PNG": ("a picture", _VIEWS),
    b"\xff\xd8\xff": ("a picture", _VIEWS),
    b"II*\x00": ("a picture", _VIEWS),
    b"MM\x00*": ("a picture", _VIEWS),
    b"\xff\xfe": ("text in UTF-16", _PLAIN),
    b"\xfe\xff": ("text in UTF-16", _PLAIN),
    b"<": ("a page or an XML file", GIVE),
    b"{": ("a JSON file", GIVE),
    b"%PDF": ("a PDF", GIVE),
}


def recognise(head: bytes, name: str) -> str:
    """PLY, LAS (and LAZ), NPY, NPZ or TEXT, by a file's first bytes. Raises SketchError for anything else."""
    if not head.strip(b"\xef\xbb\xbf \t\r\n\x00"):
        raise SketchError(f"{name} is empty.", remedy=AGAIN)
    for magic, what in _OURS.items():
        if head.startswith(magic):
            return what
    plain = head.removeprefix(b"\xef\xbb\xbf").lstrip(b" \t\r\n")
    for magic, (what, remedy) in _OTHERS.items():
        if head.startswith(magic) or plain.startswith(magic):
            raise SketchError(f"{name} is {what}, which is not read as a point cloud.", remedy=remedy)
    if b"\x00" in head or sum(byte < 9 or 13 < byte < 32 for byte in head):
        raise SketchError(f"{name} is no point cloud that is known here.", remedy="Give PLY, LAS, LAZ, XYZ (or other text with x, y, z), NPZ or NPY.")
    return TEXT
