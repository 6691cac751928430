"""A real device on its line, through the Python runtime.

- `devices.py` makes the class of a device from the model, `numbers.py` the classes of its numbers and flags.
"""
