"""Resolves telegrams: cyclic layouts of words, and the messages whose frames carry them."""

from __future__ import annotations

from collections.abc import Mapping

from fieldscribe.language.nodes import Map
from fieldscribe.model import Message, Telegram
from fieldscribe.resolve.bus import reader_of
from fieldscribe.resolve.point_facts import PointFacts
from fieldscribe.resolve.scope import Scope, humanised, source_of, titles

Telegrams = Mapping[str, tuple[Telegram, int]]
"""By name: the telegram, and how many of its words one multiplexed frame carries (0 if it is not multiplexed)."""

SPACE = "telegram"
"""The space whose points are words of a telegram."""

_MULTIPLEXED = 256
"""How many different frames a multiplexer can number."""


def telegrams_of(scope: Scope, messages: tuple[Message, ...]) -> Telegrams:
    """Return all telegrams by name, in the order of the text."""
    result: dict[str, tuple[Telegram, int]] = {}
    by_name = {message.name: message for message in messages}
    for node in scope.unique("telegrams"):
        name = str(node["name"])
        if SPACE not in scope.family.spaces:
            family = scope.header["family"]
            message = f"the family {family} has no telegrams"
            scope.report.error("family-key", message, node.span("name"), "leave it out")
            continue
        carried = _carried(scope, node, by_name)
        _check_carrier(scope, node, by_name, [telegram for telegram, _ in result.values()])
        telegram = Telegram(
            name=name,
            title=titles(node.get("title"), humanised(name)),
            direction=node["direction"],
            words=node["length"],
            message=node.get("message"),
            source=source_of(scope, node),
        )
        result[name] = (telegram, carried)
    return result


def telegram_of(scope: Scope, telegrams: Telegrams, facts: PointFacts) -> tuple[Telegram, int] | None:
    """Return the telegram that the point's group belongs to; None after a finding."""
    name = facts.group.get("telegram")
    if name is None:
        if "telegram" not in facts.group.broken:
            hint = "add `telegram: …` to the group"
            span = facts.group.span("space") if "space" in facts.group else facts.span()
            scope.report.error("missing-key", "the words of the space `telegram` belong to a telegram", span, hint)
        return None
    entry = telegrams.get(name)
    if entry is None:
        scope.unknown("telegram", name, facts.group.span("telegram"), telegrams)
    return entry


def _check_carrier(scope: Scope, node: Map, messages: Mapping[str, Message], before: list[Telegram]) -> None:
    """Report a telegram without a message, with one of the other direction, or with one that another telegram has."""
    name, direction, carrier = str(node["name"]), node["direction"], node.get("message")
    if not scope.family.lays_out_messages:
        reader_of(scope).telegram(scope, node, before)
        return
    if carrier is None:
        if "message" not in node.broken:
            text = f"nothing says which message carries `{name}`"
            scope.report.error("missing-key", text, node.span("name"), "add `message: …`")
        return
    message, other = messages.get(carrier), next((earlier for earlier in before if earlier.message == carrier), None)
    if message is not None and message.direction != direction:
        text = f"`{name}` has the direction {direction}, its message `{carrier}` has {message.direction}"
        scope.report.error("wrong-choice", text, node.span("direction"), f"write `direction: {message.direction}`")
    elif other is not None:
        text = f"the message `{carrier}` carries `{other.name}` already"
        hint = "nobody could tell whose words they are: give each telegram its own message, or make them one"
        scope.report.error("two-meanings", text, node.span("message"), hint)


def _carried(scope: Scope, node: Map, messages: Mapping[str, Message]) -> int:
    """Return how many words one of several frames carries, or 0 for a single frame; report layouts that do not fit."""
    name = node.get("message")
    if name is None or not scope.family.lays_out_messages:
        return 0
    message = messages.get(name)
    span = node.span("message")
    if message is None:
        known = [str(item["name"]) for item in scope.listed("messages")]
        if name not in known:
            scope.unknown("message", name, span, known)
        return 0
    words, multiplexed = message.words, any(role.kind == "multiplexer" for role in message.roles)
    most = words * (_MULTIPLEXED if multiplexed else 1)
    if node["length"] > most:
        text = f"the frames of `{name}` carry at most {most} words, the telegram has {node['length']}"
        hint = "its layout needs `telegram`, and a `multiplexer` where there are several frames"
        scope.report.error("too-many-items", text, span, hint)
        return 0
    return words if multiplexed else 0
