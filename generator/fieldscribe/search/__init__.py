"""Finding things in descriptions: what there is at all, and what has a word in it."""
