"""The table of facts: what is known of a device, of a point and of everything else in a description, listed once.

Each fact has its published key, what it says, its JSON Schema, its value and its class in `diff`. The exported model,
its schema, the comparison of two models, the digests and the texts for people follow from the table.

A row says first what the fact is; then, where that is not the attribute of its name, where its value comes from (`of`);
then what `diff` compares, where that is not the exported value (`differs`); then what is said of it to people (`says`).
"""
