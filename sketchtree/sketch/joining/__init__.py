"""Which branch grows from which? Clean lines, attachment costs, the arborescence, limbs, nodes."""
