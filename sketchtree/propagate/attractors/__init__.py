"""How does a tree grow to where foliage was seen (Tan et al. 2008, §3)? Branches are replaced by subtrees that come near attractors."""
