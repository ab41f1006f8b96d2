"""Where is the tree, when nobody marked it? A stroke round its crown and one along its trunk, proposed, with how sure that is."""
