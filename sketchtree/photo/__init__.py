"""One photo and a few strokes become a tree (Tan et al. 2008, "Single Image Tree Modeling")."""
