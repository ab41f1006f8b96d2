"""The paper's method, `chen` and `chen-fixed`: labels, bottom-up search, ICM and EM (Chen et al. 2008, §5.2-5.3)."""
