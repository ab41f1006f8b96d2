"""How like is a tree that was made of twenty pictures to the tree that was pictured? Ten known trees, as in Guo et al. 2018, §6.2."""
