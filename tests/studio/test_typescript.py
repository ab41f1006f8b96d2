"""The page's types are made from the messages, and whoever changes one is told how to make the other."""

import re
from typing import get_args

from sketchtree.studio import messages, typescript


def test_the_pages_types_are_up_to_date():
    assert typescript.main(["--check"]) == 0, f"run `{typescript.COMMAND}`"


def test_an_old_file_is_told_with_the_command_that_makes_it_anew(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(typescript, "TARGET", tmp_path / "messages.ts")
    typescript.TARGET.write_text("// of long ago\n")
    assert typescript.main(["--check"]) == 1
    assert capsys.readouterr().err == "messages.ts is not what messages.py says. Run `python -m sketchtree.studio.typescript`.\n"
    assert typescript.main([]) == 0
    assert typescript.main(["--check"]) == 0


def test_an_unknown_argument_is_refused(capsys):
    assert typescript.main(["--chekc"]) == 2
    assert capsys.readouterr().err == "usage: python -m sketchtree.studio.typescript [--check]\n"


def test_every_message_has_a_type_and_its_tag():
    text = typescript.source()
    for record in (*get_args(messages.Request), *get_args(messages.Event)):
        assert f'export interface {record.__name__} {{\n  type: "{record.__name__.lower()}";' in text


def test_what_comes_is_whole_and_what_is_sent_may_leave_out_what_has_a_default():
    text = typescript.source()
    assert _block(text, "Stroke").count("?:") == 0
    assert set(re.findall(r"(\w+)\?:", _block(text, "SentStroke"))) == {"pressure", "time", "width", "closed", "view_deg"}
    assert "put?: SentStroke[];" in _block(text, "Strokes")
    assert "put: Stroke[];" in _block(text, "Changed")


def test_the_page_knows_the_limits():
    assert f"export const MAX_POINTS = {messages.MAX_POINTS};" in typescript.source()


def _block(text: str, name: str) -> str:
    return re.search(rf"export interface {name} {{(.*?)\n}}", text, re.DOTALL).group(1)
