"""What moves and what collides, for games: wind, pivots, bones, capsules, and the pack that holds them."""
