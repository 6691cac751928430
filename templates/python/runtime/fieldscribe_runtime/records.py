# SPDX-License-Identifier: 0BSD
"""Immutable records. The standard library's dataclasses would import more than this whole package."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar, dataclass_transform

if TYPE_CHECKING:
    from typing import Never, Self


class _Signature:
    """The signature of a record for `help()`."""

    def __get__(self, record: object, kind: type[Record]) -> Any:
        import inspect  # only help() needs it

        either, none = inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.empty
        fields = [inspect.Parameter(name, either, default=getattr(kind, name, none)) for name in kind._fields]
        return inspect.Signature(fields)


@dataclass_transform(frozen_default=True)
class Record:
    """An object with the fields of its class in order; equal to another one if all fields are equal.

    A field without a default must be given.
    """

    _fields: ClassVar[tuple[str, ...]] = ()
    _needed: ClassVar[frozenset[str]] = frozenset()
    __signature__: ClassVar[Any] = _Signature()

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        names = [name for name, kind in cls.__annotations__.items() if not str(kind).startswith("ClassVar")]
        cls._fields = (*cls._fields, *names)
        cls._needed = frozenset([name for name in cls._fields if not hasattr(cls, name)])

    def __init__(self, *values: Any, **named: Any) -> None:
        fields = self._fields
        held = self.__dict__
        held.update(zip(fields, values, strict=False))
        held.update(named)
        if len(values) + len(named) != len(held) or not self._needed <= held.keys() <= set(fields):
            raise TypeError(f"{type(self).__name__} takes {', '.join(fields)}, not {values} and {named}")

    def __setattr__(self, name: str, value: Never) -> None:
        raise AttributeError(f"{name} cannot be changed: {type(self).__name__} is a fact", name=name, obj=self)

    def _values(self) -> tuple[Any, ...]:
        return tuple([getattr(self, name) for name in self._fields])

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and other._values() == self._values()

    def __hash__(self) -> int:
        return hash(self._values())

    def __repr__(self) -> str:
        fields = [f"{name}={value!r}" for name, value in zip(self._fields, self._values(), strict=True)]
        return f"{type(self).__name__}({', '.join(fields)})"

    def replaced(self, **changes: Any) -> Self:
        """Return a copy with some fields changed."""
        return type(self)(**{**self.__dict__, **changes})

    __replace__ = replaced
