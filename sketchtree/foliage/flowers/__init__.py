"""Flowers as meshes: petals, hearts and stalks, put together by recipes. What each species has stands in `recipes`, one TOML file a blossom."""
