"""How does a digitised tree become an exemplar? Stand it up, read its habit, measure it, add it."""
