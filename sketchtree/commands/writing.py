"""Everything a command writes: checked before the work, written whole or not at all after it."""

import dataclasses
import json
import time
from dataclasses import dataclass
from pathlib import Path

from sketchtree.errors import ExportError
from sketchtree.export.files import MESHES, PROJECTS, SKELETONS, check_extension, check_program, check_writable, write_whole

PICTURES = (".png",)
POSTERIORS = (".npz",)
WHOLE = MESHES + SKELETONS + PROJECTS + PICTURES  # what one whole tree can be written as


@dataclass(frozen=True)
class Run:
    """One run of a command: what the report says about it."""

    command: str
    seed: int
    imported: float  # seconds spent importing
    began: float  # time.perf_counter() at its start
    watch: object  # pipeline.Watch
    options: dict

    @property
    def made(self):
        """The same as the tree's file tells it."""
        from sketchtree.tree_output import Made

        return Made(self.seed, self.options)


def check_outputs(
    sketch: Path | tuple[Path, ...], output: Path, report: Path | None = None, skeleton: Path | None = None, preview: Path | None = None,
    *, posterior: Path | None = None, others: tuple[Path, ...] = (), more: dict[str, Path | None] | None = None, files=None, kinds: tuple[str, ...] = MESHES + SKELETONS + PICTURES, source: str = "the sketch itself",
) -> None:
    """Refuse, before any work, an output that can't be written, and two that are one. `files` is a `FileOptions`: what `-o` becomes; `source`: what it is made of. Raises ExportError."""
    taken = {path.resolve(): source for path in ((sketch,) if isinstance(sketch, Path) else sketch)}
    wanted = (("-o", output, kinds), ("--report", report, None), ("--skeleton", skeleton, SKELETONS), ("--preview", preview, PICTURES),
              ("--posterior", posterior, POSTERIORS), *(("--alternatives", other, None) for other in others),
              *((option, path, None) for option, path in (more or {}).items()))  # fmt: skip
    for option, path, allowed in wanted:
        if path is None:
            continue
        if allowed is not None:
            check_extension(path, allowed)
        check_program(path)
        for one in _becomes(path, files) if option == "-o" else (path,):
            if one.resolve() in taken:
                comes = "" if one == path else f" comes with {one.name}, which"
                raise ExportError(f"`{option} {path}`{comes} would overwrite {taken[one.resolve()]}.", remedy="Give it another name.")
            taken[one.resolve()] = f"what `{option}` writes"
            check_writable(one)


def _becomes(output: Path, files) -> tuple[Path, ...]:
    """Every file that the tree may be written to."""
    from sketchtree.options import FileOptions
    from sketchtree.tree_files import tree_files

    return tree_files(output, files or FileOptions()).all


def split_options(wanted: dict, *records: type) -> list:
    """One option record of each type, from those of its fields that the command line has."""
    return [record(**{f.name: wanted[f.name] for f in dataclasses.fields(record) if f.name in wanted}) for record in records]


def check_files(output: Path, files, instead: str = "") -> None:
    """Refuse, before any work, what the file can't hold. `files` is a `FileOptions`. Raises OptionError."""
    from sketchtree.tree_output import check_files

    check_files(output, files, instead)


def write_tree(
    model, output: Path, run: Run, *, skeleton: Path | None, preview: Path | None, files=None, sketches: tuple[Path, ...] = (), underlay=None
) -> tuple[str, ...]:
    """Write the tree and what else was asked for; returns warnings (a picture that could not be made). `files` is a `FileOptions`, `underlay` what a project keeps below its strokes.

    None of the `sketches` it was made of is overwritten."""
    from sketchtree.tree_output import write_output, write_skeleton_of

    shown, warnings = write_output(model, output, run.made, files, kept=sketches, underlay=underlay)
    if skeleton is not None:
        write_skeleton_of(skeleton, model.skeleton, run.made)
    pictures = [path for path in (output if output.suffix.lower() in PICTURES else None, preview) if path is not None]
    return warnings + tuple(warning for path in pictures for warning in _picture(shown, path))


def _picture(meshes, path: Path) -> tuple[str, ...]:
    from sketchtree.view import preview

    drawn, reason = preview(meshes, path)
    return () if drawn else (f"{path} was not drawn: {reason}",)


def write_drawn(drawn, output: Path, run: Run, *, frame: str, others: tuple[Path, ...] = ()) -> None:
    """The drawn branches as a skeleton file, in metres or in the sketch's own units (INTERFACES §2); other readings
    than the answer into `others`, as far as there are any."""
    told = [(output, drawn.fit.depth), *zip(others, [reading.depth for reading in drawn.fit.alternatives[1:]])]
    from sketchtree.tree_output import write_skeleton_of

    for path, depth in told:
        write_skeleton_of(path, _framed(drawn, depth, frame), run.made, **({} if frame == "world" else {"units": "sketch units", "frame": "sketch"}))


def _framed(drawn, depth, frame: str):
    if frame == "world" and depth is drawn.fit.depth:
        return drawn.skeleton
    from sketchtree.mrf.lift import lift
    from sketchtree.similarity import Similarity

    similarity = drawn.similarity if frame == "world" else Similarity(1.0, (0.0, 0.0, 0.0))
    tree = lift(drawn.graph, depth, similarity, depth_sd=drawn.fit.depth_sd)
    return tree.replace(radius=drawn.skeleton.radius * similarity.scale / drawn.similarity.scale)


def write_posterior(path: Path | None, drawn, *, frame: str) -> None:
    """The samples, in the units of the skeleton that is written beside them."""
    if path is None:
        return
    import io

    import numpy as np

    if drawn.fit.posterior is None:
        method = drawn.fit.method
        if method != "elevation":
            raise ExportError(f"`--posterior {path}`: the method `{method}` has no posterior.", remedy="Use the method `elevation`, or leave the option out.")
        raise ExportError(f"`--posterior {path}`: there is nothing to sample in this drawing.", remedy="Draw a limb beside the stem, or leave the option out.")
    scale = drawn.similarity.scale if frame == "world" else 1.0
    whole = io.BytesIO()
    np.savez_compressed(whole, **drawn.fit.posterior.columns(drawn.skeleton.node_id, scale))
    write_whole(path, whole.getvalue())


def other_readings(output: Path, count: int) -> tuple[Path, ...]:
    """DRAWN.2.swc, DRAWN.3.swc, … beside DRAWN.swc."""
    return tuple(output.with_suffix(f".{k}{output.suffix}") for k in range(2, count + 1))


def record(run: Run, drawn, model=None, *, extra_warnings: tuple[str, ...] = ()) -> dict:
    """The report of a run that has just written its files."""
    from sketchtree.report import build_report

    return build_report(drawn, model, **of_run(run), warnings=extra_warnings)


def record_forest(run: Run, forest, *, extra_warnings: tuple[str, ...] = ()) -> dict:
    """The same of a forest."""
    from sketchtree.forest_report import forest_report

    return forest_report(forest, **of_run(run), warnings=extra_warnings)


def of_run(run: Run) -> dict:
    """What every report says of its run."""
    seconds = {"import": run.imported} | run.watch.seconds | {"total": time.perf_counter() - run.began}
    seconds = {name: round(value, 4) for name, value in seconds.items()}
    return {"command": run.command, "seed": run.seed, "seconds": seconds, "options": run.options}


def write_report(path: Path | None, record: dict) -> None:
    """The report as a file, whole or not at all."""
    if path is None:
        return
    write_whole(path, (json.dumps(record, indent=1, ensure_ascii=False) + "\n").encode())


def conclude(record: dict, output: Path, progress) -> None:
    """Tell the user every warning, and in one line what was written."""
    for warning in record["warnings"]:
        progress.say(f"Note: {warning}", event="warning")
    progress.say(summary(record, output), event="done")


def summary(record: dict, output: Path) -> str:
    """One line for the user: what was written, from what, in how long."""
    drawn, total = record["segments"]["drawn"], record["segments"]["total"]
    seen = "segments that were seen" if "cloud" in record else "drawn segments"
    parts = [f"{output}: {drawn} {seen}"]
    if record["triangles"]:
        parts.append(f"{total} in all, {record['leaves']} leaves, {sum(record['triangles'].values())} triangles")
    trees = record.get("trees")
    if trees is not None:
        parts[0] = f"{output}: {len(trees)} sketch{'es' if len(trees) > 1 else ''}, {drawn} drawn segments"
        return ", ".join([*parts, f"up to {record['height']:.1f} m high, {record['seconds']['total']:.1f} s"])
    parts.append(f"template {record['template_used'] or 'none'}, {record['height']:.1f} m high, {record['seconds']['total']:.1f} s")
    return ", ".join(parts)
