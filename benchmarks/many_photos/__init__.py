"""How good are clouds made of photos? Renders of trees from known cameras, and what is measured on them."""
