import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sketchtree.sketch.files.path_data import numbers_of, path_data

NUMBER = st.integers(-400, 400).map(lambda k: k / 8)
SIZE = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7, "Z": 0}


@st.composite
def commands(draw):
    found = [("M", [draw(NUMBER), draw(NUMBER)])]
    for command in draw(st.lists(st.sampled_from("LHVCSQTAMZ"), max_size=8)):
        values = [draw(NUMBER) for _ in range(SIZE[command])]
        if command == "A":
            values[:2] = [abs(values[0]) + 1, abs(values[1]) + 1]
            values[3:5] = [int(values[3] > 0), int(values[4] > 0)]
        found.append((command, values))
    return found


def text_of(found):
    return " ".join(f"{command}{' '.join(map(repr, values))}" for command, values in found)


def relative(found):
    """The same path in small letters: every point as a step from where the pen is."""
    here = start = np.zeros(2)
    steps = []
    for command, values in found:
        points = np.array(values[-2:] if command == "A" else values, float)
        if command in "HV":
            axis = "HV".index(command)
            values = [points[0] - here[axis]]
            here = np.where(np.arange(2) == axis, points[0], here)
        elif command == "A":
            values = [*values[:5], *(points - here)]
            here = points
        elif command != "Z":
            values = (points.reshape(-1, 2) - here).ravel().tolist()
            here = points[-2:]
        start = here if command == "M" else start
        here = start if command == "Z" else here
        steps.append((command.lower(), [float(v) if k not in (3, 4) or command != "A" else int(v) for k, v in enumerate(values)]))
    return steps


def same(a, b):
    assert [(p.closed, len(p.cubics)) for p in a] == [(p.closed, len(p.cubics)) for p in b]
    for p, q in zip(a, b, strict=True):
        assert p.start == pytest.approx(q.start, abs=1e-9) and p.cubics == pytest.approx(q.cubics, abs=1e-6)


@settings(max_examples=300, deadline=None)
@given(commands())
def test_small_letters_draw_the_same_as_capitals(found):
    same(path_data(text_of(relative(found))), path_data(text_of(found)))


@settings(max_examples=300, deadline=None)
@given(commands())
def test_pieces_hang_together_and_a_closed_run_ends_where_it_began(found):
    for path in path_data(text_of(found)):
        if len(path.cubics):
            assert (path.cubics[0, 0] == path.start).all()
            assert (path.cubics[1:, 0] == path.cubics[:-1, 3]).all()
            assert not path.closed or (path.cubics[-1, 3] == path.start).all()


@settings(max_examples=200, deadline=None)
@given(commands())
def test_a_command_told_once_or_every_time_is_one_path(found):
    doubled = [entry for entry in found for _ in range(1 if entry[0] in "MZ" else 2)]
    once, last = "", ""
    for command, values in doubled:
        once += ("" if command == last and command not in "MZ" else command) + " ".join(map(repr, values)) + " "
        last = command
    same(path_data(once), path_data(text_of(doubled)))


@settings(max_examples=300, deadline=None)
@given(NUMBER, NUMBER, st.floats(1, 50), st.floats(1, 50), st.floats(-180, 180), st.booleans(), st.booleans())
def test_an_arc_lies_on_its_ellipse_and_turns_as_its_flags_say(x, y, rx, ry, turn, large, sweep):
    (path,) = path_data(f"M0 0A{rx} {ry} {turn} {int(large)} {int(sweep)} {x} {y}")
    if x == y == 0:
        assert len(path.cubics) == 0
        return
    angle = np.radians(turn)
    frame = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]]) / np.array([[rx], [ry]])
    t = np.linspace(0, 1, 17)[:, None]
    points = np.concatenate(
        [(1 - t) ** 3 * a + 3 * t * (1 - t) ** 2 * b + 3 * t**2 * (1 - t) * c + t**3 * d for a, b, c, d in path.cubics]
    )
    unit = points @ frame.T
    grow = max(np.hypot(*(frame @ (x, y))) / 2, 1.0)
    system = np.column_stack([2 * unit, np.ones(len(unit))])
    (cx, cy, rest), *_ = np.linalg.lstsq(system, (unit**2).sum(1), rcond=None)  # the circle through all of them
    span = np.hypot(*(unit[0] - unit[-1]))
    if span > 0.05:
        assert np.sqrt(max(rest + cx**2 + cy**2, 0)) == pytest.approx(grow, rel=0.02)
    corner = np.unwrap(np.arctan2(*(unit - (cx, cy)).T[::-1]))
    if span > 0.05 and abs(span / 2 - grow) > 1e-3:
        assert (corner[-1] > corner[0]) == sweep
        assert (abs(corner[-1] - corner[0]) > np.pi) == large


def test_an_arc_without_radius_is_a_line():
    for arc in ("A0 5 0 1 1 9 9", "a5 0 0 0 0 9 9"):
        (path,) = path_data("M0 0" + arc)
        assert path.cubics == pytest.approx(np.array([[[0, 0], [3, 3], [6, 6], [9, 9]]]))


def test_flags_of_arcs_need_no_space():
    same(path_data("M0 0a5 5 0 0110 0 5,5,0,10-10,0"), path_data("M0 0 a 5 5 0 0 1 10 0 a 5 5 0 1 0 -10 0"))


def test_smooth_curves_mirror_only_their_own_kind():
    def first_arm(data):
        return path_data(data)[0].cubics[-1, 1].tolist()

    assert first_arm("M0 0C0 3 6 3 6 0S9 3 9 9") == [6, -3]
    assert first_arm("M0 0Q3 3 6 0S9 3 9 9") == [6, 0]
    assert first_arm("M0 0L6 0S9 3 9 9") == [6, 0]
    assert first_arm("M0 0Q3 3 6 0T12 0") == pytest.approx([8, -2])
    assert first_arm("M0 0C0 3 6 3 6 0T12 0") == [6, 0]


@pytest.mark.parametrize(
    "data, message",
    [
        ("L3 4", "its path data do not begin with a move"),
        ("5 5L3 4", "its path data do not begin with a move"),
        ("M0 0L", "a number is missing"),
        ("M0 0LL1 1", "a number is missing"),
        ("M0 0C1 1 2 2 3", "a number is missing"),
        ("M0 0A5 5 0 2 1 9 9", "a number is missing"),
        ("M0 0L5 x", "is no number"),
        ("M0 0L5 5;6 6", "';' is no number"),
        ("M0 0L1_0 5", "'_' is no number"),
        ("M0 0Z5 5", "'5 5' is no number"),
        ("M0 0L nan 3", "a coordinate is not a finite number"),
        ("M0 0L INF 3", "a coordinate is not a finite number"),
    ],
)
def test_data_that_make_no_sense_say_why(data, message):
    with pytest.raises(ValueError, match=message):
        path_data(data)


@pytest.mark.parametrize("data", ["", "  ", "\n"])
def test_no_data_draw_nothing(data):
    assert path_data(data) == []


def test_numbers_stand_close_in_any_notation():
    assert numbers_of("1-2.5.5+3e-1-.4E2,5 ,6").tolist() == [1, -2.5, 0.5, 0.3, -40, 5, 6]
    assert numbers_of(" \t\n").tolist() == []


def test_lone_moves_are_one_dot_and_a_closed_dot_stays():
    assert [len(p.cubics) for p in path_data("M1 1M2 2M3 3")] == [0]
    assert [p.start.tolist() for p in path_data("M1 1M2 2L3 3M4 4")] == [[1, 1], [2, 2]]
    (dot,) = path_data("M1 1Z")
    assert dot.closed and len(dot.cubics) == 0
