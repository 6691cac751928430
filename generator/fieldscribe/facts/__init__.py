"""The table of facts: what is known of a device, of a point and of everything else in a description, listed once.

Each fact has its published key, what it says, its JSON Schema, its value and its class in `diff`. The exported model,
its schema, the comparison of two models, the digests and the texts for people follow from the table.
"""
