"""Resolves telegrams: cyclic layouts of words, and the messages whose frames carry them."""

from collections.abc import Mapping

from fieldscribe.language.nodes import Map
from fieldscribe.model import Message, Telegram
from fieldscribe.resolve.bus import reader_of
from fieldscribe.resolve.point_facts import PointFacts
from fieldscribe.resolve.scope import Scope, source_of, titles
from fieldscribe.text import humanised

Telegrams = Mapping[str, tuple[Telegram, int]]
"""Telegrams by name, each with how many of its words one multiplexed frame carries (0: not multiplexed)."""

SPACE = "telegram"
"""The space whose points are words of a telegram."""
SIGNAL = "signal"
"""The space whose points are bits of a message; the words of these are a telegram of the same name."""
KEY_OF = {SPACE: "telegram", SIGNAL: "message"}
"""What a group of such a space names."""

_MULTIPLEXED = 256
"""The number of frames that a multiplexer can distinguish."""


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
    for carrier in (message for message in messages if not message.roles):
        name = carrier.name
        if name in result:
            node = next(node for node in scope.listed("telegrams") if node["name"] == name)
            text, hint = f"the signals of the message `{name}` are a telegram of that name", "rename one of them"
            scope.report.error("duplicate-name", text, node.span("name"), hint)
        result[name] = Telegram(name, carrier.title, carrier.direction, 0, name, carrier.source), 0
    return result


def telegram_of(scope: Scope, telegrams: Telegrams, facts: PointFacts, space: str) -> Telegram | None:
    """Return the telegram that the point's group belongs to; None after a finding."""
    key, group = KEY_OF[space], facts.group
    name = group.get(key)
    if name is None:
        if key not in group.broken:
            hint = f"add `{key}: …` to the group"
            span = group.span("space") if "space" in group else facts.span()
            what = "words" if space == SPACE else "signals"
            text = f"the {what} of the space `{space}` belong to a {key}"
            scope.report.error("missing-key", text, span, hint)
        return None
    of_signals = space == SIGNAL  # their words are not counted yet
    known = {each: telegram for each, (telegram, _) in telegrams.items() if (telegram.words == 0) is of_signals}
    if name not in known:
        scope.unknown(key, name, group.span(key), list(known))
    return known.get(name)


def _check_carrier(scope: Scope, node: Map, messages: Mapping[str, Message], before: list[Telegram]) -> None:
    """Report a telegram without a message, with one of another direction, or with one that another telegram uses."""
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
