"""Which exemplar is a sketch most like? Recipes, the database made from them, and matching."""
