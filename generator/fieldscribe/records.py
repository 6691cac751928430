"""Classes of facts as `dataclasses` makes them, without code that is compiled while modules are imported.

A run uses few of our classes, and `dataclasses` compiles six methods for each: that was a third of what a small `check`
takes. Here `__init__` is compiled when the first object is made, and the other methods are shared. mypy holds what is
`frozen`; held at run time, it would make each object cost twice as much.
"""

from __future__ import annotations

from functools import cache
from operator import attrgetter
from typing import TYPE_CHECKING, Any, TypeVar, dataclass_transform

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

T = TypeVar("T")
_UNSAID: Any = object()


class _Field:
    """What is said of one attribute; `named` says that it is part of what is shown of an object."""

    __slots__ = ("compare", "default", "factory", "named")

    def __init__(self, default: Any, factory: Any = _UNSAID, *, compare: bool = True, named: bool = True) -> None:
        self.default, self.factory, self.compare, self.named = default, factory, compare, named


def field(
    *,
    default: Any = _UNSAID,
    default_factory: Callable[[], Any] = _UNSAID,
    compare: bool = True,
    repr: bool = True,  # noqa: A002  # the words of `dataclasses.field`
) -> Any:
    """As `dataclasses.field`."""
    return _Field(default, default_factory, compare=compare, named=repr)


@dataclass_transform(field_specifiers=(field,))
def dataclass(*, frozen: bool = False, slots: bool = False, eq: bool = True) -> Callable[[type[T]], type[T]]:
    """As `dataclasses.dataclass`, for classes whose annotations are all attributes."""

    def made(plain: type[T]) -> type[T]:
        said = vars(plain)
        own = {name: _field_of(said.get(name, _UNSAID)) for name in said.get("__annotations__", ())}
        fields: dict[str, _Field] = {**getattr(plain, "__fields__", {}), **own}
        space = {name: value for name, value in said.items() if name not in own and name not in _OF_THE_PLAIN_CLASS}
        shared: dict[str, Any] = {"__fields__": fields, "__match_args__": tuple(fields)}
        shared["__repr__"] = _showing(plain.__qualname__, tuple(name for name in fields if fields[name].named))
        shared["__dataclass_fields__"] = _StandardFields()
        shared |= _comparing(tuple(name for name in fields if fields[name].compare), frozen=frozen) if eq else {}
        slotted = {"__slots__": tuple(own)} if slots else {}
        build: Any = type(plain)
        result: Any = build(plain.__name__, plain.__bases__, shared | space | slotted)
        result.__qualname__ = plain.__qualname__
        result.__init__ = _compiled_when_used(result)
        return result  # type: ignore[no-any-return]  # `type` made it, with the attributes of the plain one

    return made


_OF_THE_PLAIN_CLASS = ("__dict__", "__weakref__")


def _field_of(said: Any) -> _Field:
    return said if isinstance(said, _Field) else _Field(said)


def _compiled_when_used(owner: Any) -> Callable[..., None]:
    """An `__init__` that makes room for the real one when the first object is made."""

    def __init__(self: Any, *values: Any, **named: Any) -> None:  # noqa: N807  # it is a method
        owner.__init__ = _compiled(owner)
        owner.__init__(self, *values, **named)

    return __init__


def _compiled(owner: Any) -> Callable[..., None]:
    """The `__init__` of a class: the only code that is generated, for nothing else takes arguments as fast."""
    space: dict[str, Any] = {"_unsaid": _UNSAID}
    arguments, lines = ["self"], []
    for name, entry in owner.__fields__.items():
        default, value = f"_default_{name}", name
        if entry.factory is not _UNSAID:
            space[default], default = entry.factory, "_unsaid"
            value = f"_default_{name}() if {name} is _unsaid else {name}"
        else:
            space[default] = entry.default
        wanted = entry.factory is _UNSAID and entry.default is _UNSAID
        arguments.append(name if wanted else f"{name}={default}")
        lines.append(f"self.{name} = {value}")
    if hasattr(owner, "__post_init__"):
        lines.append("self.__post_init__()")
    exec(f"def __init__({', '.join(arguments)}):\n  " + "\n  ".join(lines or ["pass"]), space)  # noqa: S102  # our own names
    made: Callable[..., None] = space["__init__"]
    return made


def _comparing(names: tuple[str, ...], *, frozen: bool) -> dict[str, Any]:
    """What compares objects by these attributes, and hashes those that are frozen."""
    values = _values(names)

    def __eq__(self: object, other: object) -> bool:  # noqa: N807  # it is a method
        return values(self) == values(other) if type(self) is type(other) else NotImplemented

    def __hash__(self: object) -> int:  # noqa: N807  # likewise
        return hash(values(self))

    return {"__eq__": __eq__, "__hash__": __hash__ if frozen else None}


def _showing(name: str, names: tuple[str, ...]) -> Callable[[object], str]:
    """What shows an object with these attributes."""
    values, form = _values(names), f"{name}({', '.join(f'{name}=%r' for name in names)})"
    return lambda self: form % values(self)


def _values(names: tuple[str, ...]) -> Callable[[object], tuple[Any, ...]]:
    """What gives the values of these attributes."""
    if len(names) > 1:
        return attrgetter(*names)
    return lambda self: tuple(getattr(self, name) for name in names)


class _StandardFields:
    """Lets `fields`, `replace`, `asdict` and `astuple` of the standard library work for those who import it."""

    def __get__(self, instance: object, owner: Any) -> Mapping[str, Any]:
        from dataclasses import make_dataclass

        made: Any = make_dataclass(owner.__name__, owner.__fields__)
        owner.__dataclass_fields__ = made.__dataclass_fields__  # from now on the class has them, without us
        fields: Mapping[str, Any] = made.__dataclass_fields__
        return fields


def names_of(kind: Any, /) -> tuple[str, ...]:
    """The names of the attributes of a class, or of an object of it."""
    return tuple(kind.__fields__)


def values_of(record: Any, /) -> dict[str, Any]:
    """The attributes of an object by name."""
    kind: Any = type(record)
    return dict(zip(kind.__fields__, _getters(kind)(record), strict=True))


@cache
def _places(kind: Any) -> Mapping[str, int]:
    return {name: place for place, name in enumerate(kind.__fields__)}


@cache
def _getters(kind: Any) -> Callable[[object], tuple[Any, ...]]:
    return _values(tuple(kind.__fields__))


def replace(record: T, /, **changes: Any) -> T:
    """As `dataclasses.replace`."""
    kind: Any = type(record)
    places, values = _places(kind), list(_getters(kind)(record))
    if not changes.keys() <= places.keys():
        raise TypeError(f"{kind.__name__} has no {', '.join(changes.keys() - places.keys())}")
    for name, value in changes.items():
        values[places[name]] = value
    return kind(*values)  # type: ignore[no-any-return]  # it is of the kind of the record
