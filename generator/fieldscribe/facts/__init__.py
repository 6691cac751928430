"""The table of facts: each fact of a device, of its points and of everything else in a description, listed once.

Each fact has its published key, what it says, its JSON Schema, its value and its class in `diff`. The exported model,
its schema, the comparison of two models, the digests and the texts for people follow from the table.

A row begins with the fact itself. Then follow, only where the default does not do: where its value comes from (`of`),
what `diff` compares (`differs`), and its text for people (`says`).
"""
