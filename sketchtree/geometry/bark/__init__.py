"""Which bark does the wood wear, and how is each drawn?"""

from sketchtree.geometry.bark.materials import Colour, bark_colour, bark_material, bark_names, rachis_material, twig_material

__all__ = ["Colour", "bark_colour", "bark_material", "bark_names", "rachis_material", "twig_material"]
