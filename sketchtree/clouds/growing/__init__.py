"""How would a tree of this species grow so that it reaches these points? The paper's way (Guo et al. 2018, §5)."""
