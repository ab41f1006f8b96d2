"""What tree does a recipe describe? The recipe and its keys, and the generator that grows it."""
