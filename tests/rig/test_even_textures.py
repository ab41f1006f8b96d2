"""Which sizes may textures have?"""

import numpy as np
import pytest

from sketchtree.geometry.mesh import Material
from sketchtree.rig.textures import even, even_material


@pytest.mark.parametrize(("shape", "found"), [((512, 320, 4), (512, 256, 4)), ((96, 512, 3), (128, 512, 3)), ((640, 768), (512, 1024)), ((64, 64, 4), (64, 64, 4))])
def test_sides_become_the_nearest_powers_of_two(shape, found):
    assert even(np.zeros(shape, np.uint8)).shape == found


def test_places_and_means_stay():
    image = np.zeros((96, 320, 4), np.uint8)
    image[:48, 160:] = 200
    made = even(image)
    assert made[:60, 130:].min() == 200 and made[68:].max() == 0 and made[:, :126].max() == 0
    assert made.mean() == pytest.approx(image.mean(), rel=0.02)


def test_a_material_that_is_even_stays_itself_and_others_keep_the_rest():
    good = Material("wood", base_color_texture=np.zeros((8, 16, 3), np.uint8))
    assert even_material(good) is good
    odd = Material("leaf", np.zeros((512, 320, 4), np.uint8), np.zeros((512, 320, 3), np.uint8), alpha_cutoff=0.4, translucency=0.3, translucency_texture=np.zeros((512, 320, 3), np.uint8))
    made = even_material(odd)
    assert made.base_color_texture.shape == (512, 256, 4) and made.normal_texture.shape == made.translucency_texture.shape == (512, 256, 3)
    assert (made.name, made.alpha_cutoff, made.translucency, made.roughness_texture) == ("leaf", 0.4, 0.3, None)
