"""Which pixels of a photo are trunk and branches? Photo and scribbles → matte (single-image growth paper, §II.1)."""
