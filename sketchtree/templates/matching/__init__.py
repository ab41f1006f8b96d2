"""Which exemplar is a sketch most like? Likenesses, what they weigh, and the search."""
