"""What is each stroke: a branch, a crown, the two sides of a trunk, the ground, a shadow, a root?"""
