"""From validated nodes to the model: expands what repeats, resolves names, computes what follows.

`pipeline` calls the steps in their order: `scope` (declarations), `expand` (points), `symbols` (names), `bus` (with the
telegrams), `points` (which asks `encodings`, `shapes` and `addresses`), `frames`, `commands`, `errata`, `analysis`.
"""
