"""A device as calls of a runtime's constructors: structure that languages without generated behaviour write or make.

Python writes the calls as text, `live` makes the objects of them, TypeScript writes them as JavaScript. A language
brings a `Scope`, which has its names, and a layout; nothing here knows how either looks.
"""
