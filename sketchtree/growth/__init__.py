"""How did the tree become what it is? Any `TreeSkeleton` at any time of its life, and branches grafted on a bare trunk (single-image growth, §II.3)."""
