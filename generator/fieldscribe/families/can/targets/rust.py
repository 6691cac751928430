"""CAN in generated Rust: messages, telegrams, and the points that they carry."""

from collections.abc import Iterator, Sequence

from fieldscribe.families.can import identifier_bits, of_bus
from fieldscribe.families.can.frames import carriers, frame_count, request_and_answer
from fieldscribe.model import Device, Message, Role, Telegram
from fieldscribe.targets.identifiers import Names, Owner
from fieldscribe.targets.rust.conformance import item_row
from fieldscribe.targets.rust.layout import Item, Lines, array, assignment, binding, sentence
from fieldscribe.targets.rust.literals import integer, mask, type_name, value_name
from fieldscribe.targets.rust.scope import CratePoint, CrateScope, RustFamily, Snippet, Table, code_names, constants
from fieldscribe.text import rust_string

_NUMBERED = ("unit", "address", "raw", "word")


def context(device: Device) -> dict[str, object]:
    """Return the names that the family's template uses."""
    bus, carrying = device.bus, carriers(device)
    return {
        "example_link": str(bus.units[0]),
        "exception_type": "u16",
        "exception_names": code_names(bus.exceptions),
        "units": f"({bus.units[0]}, {bus.units[1]})",
        "identifier_bits": identifier_bits(bus),
        "bitrate": "" if of_bus(bus).bitrate is None else integer(of_bus(bus).bitrate or 0),
        "dialogues": (
            _dialogue(device.messages, "READ", writes=False),
            _dialogue(device.messages, "WRITE", writes=True),
        ),
        "messages": tuple(_message(message) for message in device.messages if message.roles),
        "message_names": array(
            Item("pub const MESSAGES", "&[&Message]"),
            [f"&messages::{message.name.upper()}" for message in device.messages if message.roles],
        ),
        "signals": [_signals(message) for message in device.messages if message.fields],
        "numbers": (("exceptions", "Exception codes.", constants(bus.exceptions, "u16", "code")),),
        "telegrams": [_telegram(telegram, carrying[telegram.name]) for telegram in _in_frames(device)],
    }


def _in_frames(device: Device) -> list[Telegram]:
    """Return the telegrams that come in frames."""
    carrying = carriers(device)
    return [telegram for telegram in device.telegrams if telegram.name in carrying and carrying[telegram.name].words]


def traits(subject: CratePoint, scope: CrateScope) -> Iterator[str]:
    """Yield the trait of a point: a parameter is read word by word, a point of a telegram is received in frames."""
    if subject.point.telegram is None:
        yield "impl runtime::can::Parameter {}"
    if subject.point.place.bit is not None:
        message = type_name(subject.point.telegram or "")
        yield f"impl runtime::can::Carried {{ type Message = crate::signals::{message}; }}"
    telegram = _received(subject, scope)
    if telegram is not None:
        yield f"impl runtime::can::Received {{ type Telegram = crate::telegrams::{type_name(telegram)}; }}"


def _received(subject: CratePoint, scope: CrateScope) -> str | None:
    """Return the telegram whose frames carry a point; None if its words cannot be matched to each other."""
    point = subject.point
    _, message = scope.telegrams.get(point.telegram or "", (None, None))
    if not point.readable or message is None or not message.words:
        return None
    frames = {position // message.words for position in point.addresses}
    return point.telegram if len(frames) == 1 or len(point.addresses) == 2 else None


def identifiers(device: Device) -> Iterator[Names]:
    """Yield the names of messages and telegrams."""
    for message in device.messages:
        yield Names("Rust, module `messages`", Owner("message", message.name), (message.name.upper(),))
    for telegram in device.telegrams:
        yield Names("Rust, module `telegrams`", Owner("telegram", telegram.name), (type_name(telegram.name),))


def _dialogue(messages: Sequence[Message], name: str, *, writes: bool) -> tuple[str, str, str]:
    """Return the constants of the request that reads or writes a parameter, and of its answer; empty without one."""
    request, answer = request_and_answer(messages, writes=writes)
    if request is None or (answer is None and not writes):
        return name, "", ""
    return name, request.name.upper(), "None" if answer is None else f"Some(&messages::{answer.name.upper()})"


def _message(message: Message) -> tuple[str, Lines]:
    """Return the comment of a message, and the lines of its constant."""
    width = "u16" if message.identifier <= 0xFFFF else "u32"
    roles = (f"        Role::{_role(role)}," for role in message.roles)
    adds_unit = "true" if message.adds_unit else "false"
    head = (f"    {field}," for field in (rust_string(message.name), mask(message.identifier, width), adds_unit))
    literal = ("Message::new(", *head, "    [", *roles, "    ],", ")")
    return sentence(message.name), assignment(4, Item(f"pub const {message.name.upper()}", "Message"), literal)


def _signals(message: Message) -> dict[str, object]:
    """Return the context of the template for a message of signals."""
    words = {place: field.word for place, field in enumerate(message.fields)}
    return {
        "doc": sentence(message.name),
        "name": type_name(message.name),
        "lines": binding(8, Item("const NAME", "&'static str"), rust_string(message.name)),
        "id": mask(message.identifier, "u16" if message.identifier <= 0xFFFF else "u32"),
        "adds_unit": "true" if message.adds_unit else "false",
        "length": message.length,
        "every": "None" if message.every is None else f"Some({integer(message.every)})",
        "words": sum(field.words for field in message.fields),
        "rows": [
            (
                field.start,
                field.width,
                "true" if field.low_first else "false",
                ", ".join(f"({words[at]}, &[{', '.join(map(integer, raws))}])" for at, raws in field.when),
            )
            for field in message.fields
        ],
    }


def _role(role: Role) -> str:
    if role.kind in _NUMBERED:
        return f"{role.kind.capitalize()}({role.number})"
    if role.kind == "xor":
        return f"Xor(0b{role.number >> 4:04b}_{role.number & 15:04b})"
    return f"Constant(0x{role.number:02X})" if role.kind == "constant" else "Multiplexer"


def _telegram(telegram: Telegram, message: Message) -> dict[str, object]:
    return {
        "doc": sentence(telegram.name),
        "name": type_name(telegram.name),
        "lines": binding(8, Item("const NAME", "&'static str"), rust_string(telegram.name)),
        "slots": frame_count(telegram, message),
        "message": message.name.upper(),
    }


def kinds(subject: CratePoint, scope: CrateScope) -> Iterator[str]:
    """Yield the kinds of vectors of a point that comes in frames."""
    if subject.point.form != "text" and _received(subject, scope) is not None:
        yield "can_telegram"
    if subject.point.place.bit is not None:
        yield "can_signal"


def telegram_of(scope: CrateScope) -> tuple[str, Snippet]:
    """Return an example for the documentation: a telegram with a point that needs no other, and lines that read it."""
    come = {subject.item: subject for subject in scope.subjects if _received(subject, scope) is not None}
    needs = {item: subject.point.scale_arguments for item, subject in come.items()}
    plain = [subject for item, subject in come.items() if not needs[item] and not subject.point.specials]
    if not plain:
        return "", Snippet()
    scaled = [subject for subject in plain if subject.point.form == "scaled"]
    first = min(scaled or plain, key=lambda subject: subject.point.rank)
    lines = [f"let value = client.receive::<p::{first.name}>()?; // waits for its next frame"]
    lines.append('println!("it is {value:?}");')
    names = ["Receiver", "telegrams"]
    needy = (item for item in come if needs[item] and come[item].point.telegram == first.point.telegram)
    for subject in (come[item] for item in needy if come.keys() >= {*needs[item]}):
        factors = needs[subject.item]
        fields = ", ".join(f"{value_name(name)}: last.raw::<p::{come[name].name}>()?" for name in factors)
        lines += ["let last = client.listener(); // what came so far"]
        lines += [f"let with = with::{subject.factors_struct} {{ {fields} }};"]
        names.append("with")
        lines += [f'println!("it is {{:?}}", last.value_with::<p::{subject.name}>(with)?);']
        break
    return f"telegrams::{type_name(first.point.telegram or '')}", Snippet(tuple(lines), frozenset(names))


def tables_of_frames(device: Device) -> Iterator[Table]:
    """Yield the tables of telegrams that come in frames."""
    names = [telegram.name for telegram in _in_frames(device)]
    if names:
        rows = tuple(item_row(name, "telegrams", "telegram", type_name(name)) for name in names)
        yield Table("can_taken", "can_taken", rows, "can_taken")
        yield Table("can_carrier", "can_carrier", rows, "can_carrier")


IN_RUST = RustFamily(
    context,
    traits,
    identifiers,
    kinds=kinds,
    tables_of_frames=tables_of_frames,
    refusals="constant",
    names=("Frame",),
    transports=("std", "embedded-can"),
    client_parameter=("L", "()", "Listener"),
    telegram=telegram_of,
)
