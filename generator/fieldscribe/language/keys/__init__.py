"""The table of all keys. The JSON Schema, KEYS.md, the checks of files and all lists of keys follow from it.

To add a key:

1. Write one `Key` (see `fieldscribe/schema_types.py`) in the module here that has its neighbours: `files`, `points`
   (also for keys nested in the facts of a point), `meaning` or `bus`; for one family alone in the part `description`
   of that family. Its `places` come from `places.py`.
2. Read it where its neighbours are read, in `resolve/` (`facts.get("name")`; most are read in `_terms_of` of
   `resolve/points.py`). Give the model a field with a default: in `Terms` (and its line in `Point`), or in `Shape` if
   encoding depends on it. If nearly every point has another value, put the field into `Point` itself. The key
   is then `identity=True` if further sets do not inherit it, else it stands in `_IDENTITY` of `resolve/shapes.py`:
   `Terms` and `Shape`, which points share, must not depend on such a key.
3. Fields of `Terms` and `Shape` reach generated code. If the fact is for people only, clear it in `code_view.py`, and
   say `for_people` in its row of step 4.
4. Add a row to the table of facts (`fieldscribe/facts/points.py`): digest, pages, export and `diff` follow. A new
   published fact raises `FORMAT` in `facts/devices.py` (and its number in `tests/export/test_export.py`), and has a
   line in `tests/export/sample_drive.json`.
5. Run `make keys`: editors, KEYS.md and the schema of the export know the key now.
6. Use it in a description of `tests/devices/` or a test, and add a wrong use to `tests/bad/`.
"""

from fieldscribe.families import Family, families
from fieldscribe.language.keys import bus, files, meaning, points
from fieldscribe.schema_types import Items, Key, Place


def keys_of_family(bus_family: Family) -> tuple[Key, ...]:
    """Return the keys that only this family has."""
    part = bus_family.part("description")
    return () if part is None else tuple(part.KEYS)


TABLE: tuple[Key, ...] = (
    *files.HEADS,
    *points.WHICH,
    *meaning.KEYS,
    *points.USING,
    *files.SECTIONS,
    *points.NESTED,
    *bus.KEYS,
    *files.MOVING,
    *(key for bus_family in families() for key in keys_of_family(bus_family)),
)
"""All keys, in the order of KEYS.md; those of one family alone come last."""

_AT: dict[Place, dict[str, Key]] = {}
for _key in TABLE:
    for _place in _key.places:
        _AT.setdefault(_place, {})[_key.name] = _key


def keys_of(place: Place) -> dict[str, Key]:
    """Return the keys that may stand in a place, by name."""
    keys = _AT.get(place, {})
    return keys if place.may_be is None else keys_of(place.may_be) | keys


def required(place: Place) -> tuple[str, ...]:
    """Return the keys that a place must have."""
    return (*place.required, *(name for name, key in keys_of(place).items() if place in key.required))


def needs(place: Place) -> dict[str, list[str]]:
    """Return the keys of a place that need other keys, with those."""
    known = keys_of(place)
    needed_by = {name: [needed for needed in key.needs if needed in known] for name, key in known.items()}
    if place.may_be is not None:
        first, *others = required(place.may_be)
        needed_by |= {name: [first, *needed_by[name]] for name in keys_of(place.may_be)} | {first: others}
    return {name: needed for name, needed in needed_by.items() if needed}


def inherited(place: Place) -> tuple[str, ...]:
    """Return the keys of a place that apply to all points below it."""
    return tuple(name for name, key in keys_of(place).items() if place in key.inherited)


def facts_of(place: Place, *subjects: str) -> tuple[str, ...]:
    """Return the keys of a place that are about WHOLE_NUMBERS, NUMBERS or TEXTS."""
    return tuple(name for name, key in keys_of(place).items() if key.of in subjects)


def identifying_keys(place: Place) -> frozenset[str]:
    """Return the keys of a place that identify a point, so that further sets do not inherit them."""
    return frozenset(name for name, key in keys_of(place).items() if key.identity)


def lists_with(place: Place, name: str) -> tuple[str, ...]:
    """Return the keys of a place whose values are lists of mappings that have the key `name`."""
    return tuple(
        key.name
        for key in keys_of(place).values()
        for kind in key.shape.kinds
        if isinstance(kind, Items) and any(name in keys_of(item) for item in kind.item.kinds if isinstance(item, Place))
    )
