"""How does the wood run through the points? A graph of neighbours, ways along it from the foot, layers, limbs, thickness."""
