"""What `docs/game.md` says is what the code does."""

import dataclasses
import re
from pathlib import Path

import pytest

from sketchtree.rig.manifest import pack_schema
from sketchtree.rig.pack import pack_roles
from sketchtree.rig.sway import Sway

TEXT = (Path(__file__).resolve().parents[2] / "docs" / "game.md").read_text()
CODE = re.findall(r"```(glsl|hlsl|js)\n(.*?)```", TEXT, flags=re.DOTALL)


@pytest.mark.parametrize("number", range(4), ids=["godot", "unity", "unreal", "three"])
def test_every_shader_has_the_formulas_constants(number):
    _, code = CODE[number]
    k = Sway()
    assert f"({k.lean:g} + {k.gust:g} * sin(" in code
    assert re.search(rf"\* {k.bough:g} \* (reach|R) ", code)
    leaf = k.leaf * (100.0 if "PreSkinned" in TEXT.split(code)[0].rsplit("###", 1)[1] else 1.0)
    assert f"* {leaf:.1f} *" in code or f"* {leaf:g} *" in code
    for speed in (k.gusts_a_second, k.boughs_a_second, k.leaves_a_second):
        assert re.search(rf"\b{speed:g} \* (TIME|time|t|T)\b", code)


def test_there_are_four_shaders():
    assert [language for language, _ in CODE] == ["glsl", "hlsl", "hlsl", "js"]


def test_every_file_of_a_pack_is_told_of():
    for name in pack_roles("oak", 2, impostor=True):
        assert f"`{name}`" in TEXT, name


def test_the_formulas_constants_are_in_the_schema_as_numbers():
    formula = pack_schema()["properties"]["wind"]["properties"]["formula"]
    assert formula["additionalProperties"] == {"type": "number"} and all(isinstance(value, float) for value in dataclasses.asdict(Sway()).values())
