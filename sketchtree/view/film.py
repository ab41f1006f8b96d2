"""How do pictures become a film? GIF, WebP, APNG, MP4.

Pictures are asked for one at a time, so that they may lie on the disk; all are of one size. The last one may stay a while. The same pictures make
the same bytes. GIF and APNG are written here (`gif.py`, `apng.py`), WebP by Pillow; MP4 by the program ffmpeg, run as a process of its own: the one on the
PATH if it has H.264, else the one that the package imageio-ffmpeg brings. H.264 in yuv420p with even sides is what all browsers play; without it
there is no MP4 rather than one that they don't.
"""

import io
import shutil
import subprocess
import tempfile
from collections.abc import Iterator, Sequence
from fractions import Fraction
from pathlib import Path

from PIL import Image

from sketchtree.errors import ExportError, OptionError
from sketchtree.export.files import check_extension, check_writable, write_whole
from sketchtree.view.apng import apng_bytes
from sketchtree.view.gif import gif_bytes

FILMS = (".gif", ".webp", ".apng", ".mp4")
"""Extensions of films."""

MOST_FRAMES = 720
_SHORTEST, _LONGEST = 0.1, 600  # seconds
_QUICKEST = 10  # milliseconds a picture: the least that a GIF can say
_OTHERWISE = "ask for a .gif, .webp or .apng"


def check_film(path: str | Path) -> None:
    """Refuse, before the work, a film that can't be written. Raises `ExportError`."""
    suffix = check_extension(path, FILMS)
    check_writable(path)
    if suffix == ".mp4" and encoder() is None:
        found = "no ffmpeg was found" if next(_programs(), None) is None else "the ffmpeg that was found has no H.264 (libx264)"
        raise ExportError(f"Can't write {path}: {found}.", remedy=f"Install one, `pip install 'sketchtree[video]'`, or {_OTHERWISE}.")


def check_length(frames: int, seconds: float, hold: float = 0.0) -> None:
    """Raises `OptionError` for a number of pictures, or a time, that no film can have."""
    if not 2 <= frames <= MOST_FRAMES:
        raise OptionError(f"A film of {frames} frames can't be made.", remedy=f"Ask for 2 to {MOST_FRAMES}.")
    if not _SHORTEST <= seconds <= _LONGEST:
        raise OptionError(f"A film of {seconds:g} seconds can't be made.", remedy=f"Ask for {_SHORTEST:g} to {_LONGEST:g}.")
    if not 0 <= hold <= _LONGEST:
        raise OptionError(f"The last picture of a film can't stay for {hold:g} seconds.", remedy=f"Ask for 0 to {_LONGEST:g}.")


def encoder() -> str | None:
    """An ffmpeg that has H.264; None: there is none."""
    return next((program for program in _programs() if _has_h264(program)), None)


def write_film(path: str | Path, pictures: Sequence[Image.Image], seconds: float, *, hold: float = 0.0) -> None:
    """Write pictures as a film that runs for so many seconds, and `hold` seconds more on its last, again and again. Whole or not at all."""
    path = Path(path)
    suffix = check_extension(path, FILMS)
    if suffix == ".mp4":
        write_whole(path, _mp4(pictures, seconds, hold))
        return
    shown = durations(len(pictures), seconds, hold)
    write_whole(path, {".gif": gif_bytes, ".apng": apng_bytes, ".webp": _webp}[suffix](pictures, shown))


def durations(count: int, seconds: float, hold: float) -> list[int]:
    """Milliseconds of each picture, in hundredths of a second as GIF counts; all but the hold make up `seconds`."""
    ends = [round(100 * seconds * (k + 1) / count) for k in range(count)]
    shown = [max(10 * (after - before), _QUICKEST) for before, after in zip([0, *ends], ends)]
    return [*shown[:-1], shown[-1] + 10 * round(100 * hold)]


class _Rest:
    """All pictures but the first as Pillow takes a file of several: it asks for one after the other."""

    def __init__(self, pictures: Sequence[Image.Image]):
        self.pictures, self.n_frames, self.shown = pictures, len(pictures) - 1, pictures[0]

    def seek(self, k: int) -> None:
        self.shown = self.pictures[k + 1].convert("RGB")

    def __getattr__(self, name: str):
        return getattr(self.shown, name)


def _webp(pictures: Sequence[Image.Image], shown: Sequence[int]) -> bytes:
    film = io.BytesIO()
    pictures[0].save(film, "WEBP", save_all=True, append_images=[_Rest(pictures)] if len(pictures) > 1 else [], duration=list(shown), loop=0, quality=85, method=4)
    return film.getvalue()


def _programs() -> Iterator[str]:
    """Every ffmpeg that is here, the machine's own first."""
    if own := shutil.which("ffmpeg"):
        yield own
    try:
        from imageio_ffmpeg import get_ffmpeg_exe

        yield get_ffmpeg_exe()
    except (ImportError, RuntimeError):  # not installed, or without a program for this machine
        return


def _has_h264(program: str) -> bool:
    try:
        said = subprocess.run([program, "-hide_banner", "-loglevel", "error", "-encoders"], capture_output=True, text=True, errors="replace", timeout=60)
    except (OSError, subprocess.TimeoutExpired):
        return False
    return " libx264 " in said.stdout


def _mp4(pictures: Sequence[Image.Image], seconds: float, hold: float) -> bytes:
    """H.264; sides are made even."""
    program = encoder()
    if program is None:
        raise ExportError("No ffmpeg with H.264 was found.", remedy=f"Install one, `pip install 'sketchtree[video]'`, or {_OTHERWISE}.")
    width, height = (n - n % 2 for n in pictures[0].size)
    rate = Fraction(len(pictures) / seconds).limit_denominator(1001)
    with tempfile.TemporaryDirectory(prefix="sketchtree-film-") as folder:
        film = Path(folder) / "film.mp4"
        source = ["-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}", "-r", str(rate), "-i", "-"]
        codec = ["-c:v", "libx264", "-crf", "18", "-preset", "slow", "-threads", "1", "-pix_fmt", "yuv420p"]
        exact = ["-fflags", "+bitexact", "-flags:v", "+bitexact", "-map_metadata", "-1", "-movflags", "+faststart"]
        with (Path(folder) / "said").open("w+b") as said:
            run = subprocess.Popen([program, "-loglevel", "error", "-y", *source, *codec, *exact, str(film)], stdin=subprocess.PIPE, stderr=said)
            _fed(run, pictures, (0, 0, width, height), round(hold * float(rate)))
            if run.returncode == 0 and film.exists():
                return film.read_bytes()
            said.seek(0)
            last = said.read().decode(errors="replace").strip().splitlines()[-1:]
    raise ExportError(f"ffmpeg made no film: {last[0] if last else 'it gave no reason'}.", remedy=f"{_OTHERWISE[0].upper()}{_OTHERWISE[1:]}.")


def _fed(run: subprocess.Popen, pictures: Sequence[Image.Image], box, more: int) -> None:
    """Give the process every picture, the last one so many times more, and wait for its end."""
    try:
        for k in range(len(pictures)):
            raw = pictures[k].convert("RGB").crop(box).tobytes()
            for _ in range(1 + more * (k == len(pictures) - 1)):
                run.stdin.write(raw)
        run.stdin.close()
    except BrokenPipeError:  # it has ended; its status tells
        pass
    except BaseException:
        run.kill()
        raise
    finally:
        run.wait()
