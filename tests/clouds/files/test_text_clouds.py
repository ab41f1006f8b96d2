"""Text: columns by their header or by what their numbers look like."""

import numpy as np
import pytest

from sketchtree.clouds.files.read_cloud import read_placed
from sketchtree.errors import SketchError

XYZ = np.array([[0.5, 1.25, -2.0], [1.5, 2.0, 3.0], [4.0, 5.0, 6.75]])


def read(tmp_path, text: str, name: str = "cloud.xyz"):
    (tmp_path / name).write_text(text, encoding="utf-8", newline="")
    return read_placed(tmp_path / name)


def refused(tmp_path, text: str) -> str:
    with pytest.raises(SketchError) as error:
        read(tmp_path, text)
    return str(error.value)


def lines(separator: str, rows=XYZ, comma: bool = False) -> str:
    text = "".join(separator.join(f"{value:g}" for value in row) + "\n" for row in rows)
    return text.replace(".", ",") if comma else text


@pytest.mark.parametrize("separator", [" ", "\t", ",", ", ", ";", "   "])
def test_every_separator(tmp_path, separator):
    np.testing.assert_array_equal(read(tmp_path, lines(separator)).cloud.xyz, XYZ)


@pytest.mark.parametrize("separator", [" ", "\t", ";"])
def test_decimal_commas_are_read_and_that_is_said(tmp_path, separator):
    placed = read(tmp_path, lines(separator, comma=True))
    np.testing.assert_array_equal(placed.cloud.xyz, XYZ)
    assert placed.remarks == ("cloud.xyz writes decimals with a comma; they were read so.",)


@pytest.mark.parametrize("before", ["# made by a scanner\n", "// x y z\n", "3\n", "\ufeff", "\r\n\r\n", "X Y Z\n", '"X [m]" "Y [m]" "Z [m]"\n'])
def test_what_stands_before_the_points_is_passed_over(tmp_path, before):
    np.testing.assert_array_equal(read(tmp_path, before + lines(" ")).cloud.xyz, XYZ)


def test_comments_between_points_and_a_blank_at_the_end_of_lines_do_no_harm(tmp_path):
    np.testing.assert_array_equal(read(tmp_path, "1 2 3 \n# pause\n\n4 5 6 # last \n").cloud.xyz, [[1, 2, 3], [4, 5, 6]])


def test_a_header_says_which_column_is_what(tmp_path):
    cloud = read(tmp_path, "time,Red,Green,Blue,Z,Y,X\n9,255,0,51,3,2,1\n9,0,255,51,6,5,4\n").cloud
    np.testing.assert_array_equal(cloud.xyz, [[1, 2, 3], [4, 5, 6]])
    np.testing.assert_allclose(cloud.colour, [[1, 0, 0.2], [0, 1, 0.2]], atol=1e-6)


def test_a_comment_may_be_the_header(tmp_path):
    np.testing.assert_array_equal(read(tmp_path, "//intensity X Y Z\n7 1 2 3\n7 4 5 6\n").cloud.xyz, [[1, 2, 3], [4, 5, 6]])


def test_without_a_header_colours_are_whole_numbers_and_normals_have_length_1(tmp_path):
    cloud = read(tmp_path, "1 2 3 -812.5 255 0 51 0 0.6 0.8\n4 5 6 -90.5 0 255 51 1 0 0\n").cloud
    np.testing.assert_allclose(cloud.colour, [[1, 0, 0.2], [0, 1, 0.2]], atol=1e-6)
    np.testing.assert_allclose(cloud.normal, [[0, 0.6, 0.8], [1, 0, 0]], atol=1e-7)


def test_numbers_that_are_none_are_left_out_and_that_is_said(tmp_path):
    placed = read(tmp_path, "1 2 3\nnan 5 6\n7 8 inf\n1 1e300 1\n")
    np.testing.assert_array_equal(placed.cloud.xyz, [[1, 2, 3]])
    assert placed.remarks == ("3 of 4 points of cloud.xyz are not finite, or nowhere near the rest; they were left out.",)


def test_a_word_among_numbers_is_named_by_its_line(tmp_path):
    text = "# one\n" + "1 2 3\n" * 400 + "4 oak 6\n"
    assert refused(tmp_path, text) == "Line 402 of cloud.xyz has `oak` where a number should stand. Mend that line, or take it out."


def test_a_short_line_is_named(tmp_path):
    assert refused(tmp_path, "1 2 3\n" * 300 + "4 5\n") == "Line 301 of cloud.xyz has 2 columns; those before it have 3 or more. Mend that line."


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("Dear all,\nthe cloud follows.\n", "cloud.xyz is text without points. Give lines of x y z, with or without colours."),
        ("1 2\n3 4\n", "cloud.xyz is text without points. Give lines of x y z, with or without colours."),
        ("lon,lat,day\n1,2,3\n", "The columns of cloud.xyz are named lon, lat, day; none are x, y and z. Name three of them x, y and z."),
        ("x,y,day\n1,2,3\n", "The columns of cloud.xyz are named x, y, day; none are x, y and z. Name three of them x, y and z."),
        ("100\n50\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n", "cloud.xyz is a PTX scan, which is not read. Convert it to LAZ or PLY (CloudCompare and PDAL do)."),
    ],
)
def test_text_without_a_cloud_is_named(tmp_path, text, says):
    assert refused(tmp_path, text) == says
