"""The example of a photo with scribbles on it opens as one has drawn it: the photo under the page, each scribble a stroke over its pixels."""

import asyncio
import io
import json

import numpy as np
import pytest
from PIL import Image
from talking import talking

from sketchtree.scribbled_tree import on_photo
from sketchtree.sketch.strokes import StrokeKind
from sketchtree.studio import examples, messages
from sketchtree.studio.making.gallery import example_picture
from sketchtree.studio.making.trunk_asked import TrunkWish
from sketchtree.studio.scribbled_example import scribbled_example

NAME = "sugar_maple.jpg"
SAID = json.loads(examples.scribbles(NAME))


@pytest.fixture(autouse=True)
def shelf(tmp_path, monkeypatch):
    """Journals of this test."""
    monkeypatch.setenv("SKETCHTREE_RECOVERY", str(tmp_path / "shelf"))


def test_its_scribbles_lie_on_the_pixels_that_its_file_names():
    wish = TrunkWish.of(scribbled_example(NAME), "maple")
    place = wish.place
    assert place.width / place.height == pytest.approx(SAID["width"] / SAID["height"])
    lines = on_photo(wish.strokes, (place.x, place.y), (SAID["width"] / place.width, SAID["height"] / place.height))
    for side in (StrokeKind.FOREGROUND, StrokeKind.BACKGROUND):
        own = [line for line in lines if line.kind == side]
        assert len(own) == len(SAID[side.value]) and {round(line.width, 6) for line in own} == {SAID["brush"]}
        for line, said in zip(own, SAID[side.value], strict=True):
            np.testing.assert_allclose(line.points * (1, -1), said, atol=1e-6)


def test_it_opens_as_a_step_and_its_tree_is_taken_from_its_scribbles():
    async def test():
        async with talking() as talk:
            await talk.say(messages.Open(name=NAME, example=True))
            document = talk.engine.made[-1][1]
            assert document.trunk.on and document.underlay.photo and document.name == "sugar_maple"
            assert len(document.strokes) == len(SAID["foreground"]) + len(SAID["background"])
            await talk.say(messages.Undo())
            assert talk.engine.made[-1][1].underlay is None

    asyncio.run(test())


def test_the_gallery_shows_the_photo_with_its_scribbles():
    shown = np.asarray(Image.open(io.BytesIO(example_picture(NAME))), int)
    assert max(shown.shape[:2]) <= 320 and shown.shape[2] == 3
    colourful = np.ptp(shown, axis=2) > 60  # the photo is grey
    assert 0.005 < colourful.mean() < 0.2
