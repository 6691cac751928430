"""A real device on its line, through the Python runtime.

- `lines.py` reads the text that names a line (`tcp://host:port`), and those that `fieldscribe.toml` names.
- `connection.py` opens a line by `families/<family>/lines.py`, and makes devices on it: their classes come from the
  model, with the calls that the Python target writes.
- `readings.py` and `writing.py` do the work of the commands; they print nothing.
- `snapshots.py` stores what a device holds in a file; `restoring.py` finds the order of writes, and logs them.
"""

from fieldscribe.resources import use_python_runtime

use_python_runtime()
