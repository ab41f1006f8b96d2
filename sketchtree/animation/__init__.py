"""A finished tree that moves: joints, keys and morphs for the growth of its meshes."""
