"""A device as calls of the runtime's constructors, for languages whose generated code has facts and no behaviour.

Python writes the calls as text, TypeScript as JavaScript; `live` executes them. A language adds a `Scope` with its
names, and a layout; nothing here depends on either.
"""
