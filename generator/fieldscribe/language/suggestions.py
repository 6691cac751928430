"""What to write instead of what other tools and languages would have: tables of keys, patterns and hints.

A new suggestion is one row of `VALUES` (by the key of the value) or of `KEYS`; those for formulas stand
in `formula/suggestions.py`.
`tests/language/test_hints.py` checks that what a hint suggests is accepted.
"""

import re
from collections.abc import Callable, Collection, Mapping
from decimal import Decimal
from typing import Any

from fieldscribe.language.formula.suggestions import exact_scale
from fieldscribe.language.nodes import Map, Seq
from fieldscribe.language.numbers import number_in

_LONGEST = 200
_NUMBER = r"[-+]?[0-9][0-9A-Fa-fxX]*(?:\.[0-9]+)?[hH]?"
_DECIMAL = r"[-+]?[0-9]+(?:\.[0-9]+)?(?:E[-+]?[0-9]+)?"
_CODE = r"-?[0-9]+|0x[0-9A-Fa-f]+|[0-9A-Fa-f]+h|[Hh]'[0-9A-Fa-f]+"
_PLAIN = r"[^,\[\]{}]+"
_LIST = rf"\[({_PLAIN}(?:, {_PLAIN}){{0,15}})\]"
_WORD = r"[^\W\d][^,\[\]{}]*"
_TO = r"(?:\.\.|-|\u2013|\u2014|~|:|;|\.\.\.|\u2026|\u00f7|to|bis|through)"
_INTERVAL = re.compile(rf"[\[(]?\s*({_NUMBER})\s*{_TO}\s*({_NUMBER})\s*[\])]?\s*[^\s\d]{{0,4}}")
_PAIRS = re.compile(r"([-+]?[0-9]+)\s*[=:]\s*([A-Za-z][A-Za-z0-9_ ]*)")
LANGUAGES = {"german": "de", "deutsch": "de", "english": "en", "french": "fr", "italian": "it", "spanish": "es"}
_WORD_ORDER = r"[-_ ]?(?:be|le|abcd|cdab|badc|dcba|swap(?:ped)?|big|little)"
_ONE_BIT = " in the space `coil` or `discrete`; one bit of a word is `bits: 0`, without a type"
_BYTE = " with the `bits: 7..0` that it takes of its word, or `type: {}`"
_WHICH_NUMBER = r"say which number it is: `printed: {wire: \g<0>}`, or a name of `numbering`"
_TYPES = (
    ("bit", "bool|boolean|coil|flag|discrete|bit1", _ONE_BIT),
    ("u8", "uint8|byte|usint|uchar|unsigned8|unsigned[_ ]char|uint8_t", _BYTE.format("u16")),
    ("s8", "int8|i8|sint|char|signed8|signed[_ ]char|int8_t", _BYTE.format("s16")),
    ("u16", "uint16|word|uint|ushort|unsigned|unsigned16|uint16_t|w|register|enum|bitfield", ""),
    ("u16", "unsigned[_ ]short|unsigned[_ ]int", ""),
    ("s16", "int16|i16|short|signed|signed16|int16_t|sint16|signed[_ ]short|signed[_ ]int", ""),
    ("u32", "uint32|dword|udint|ulong|unsigned32|uint32_t|unsigned[_ ]long", ""),
    ("s32", "int32|i32|dint|long|signed32|int32_t|sint32|signed[_ ]long", ""),
    ("u64", "uint64|qword|lword|ulint|unsigned64|uint64_t|unsigned[_ ]long[_ ]long", ""),
    ("s64", "int64|i64|lint|signed64|int64_t|sint64|long[_ ]long|signed[_ ]long[_ ]long", ""),
    ("f32", "float|real|float32|single|ieee754|ieee", ""),
    ("f64", "double|lreal|float64", ""),
    ("bytes", r"ip|ipv4|ipaddr|ip[_ ]address", " with `notation: ipv4`"),
    ("bytes", r"mac|eui48|mac[_ ]address", " with `notation: eui48`"),
    ("bytes", r"raw|hex|octets?|byte\[\]|octet[_ ]string", " with `length: \u2026` in words"),
    ("u32", r"time|timestamp|unix[_ ]?time|epoch|time_t", " with `notation: time since 1970-01-01`"),
    ("text", r"string|str|ascii|char\[\]|visible_string", " with `characters: \u2026`"),
)
"""Our type, its names elsewhere, and what else a point of this type needs."""


def _ends(match: re.Match[str]) -> str | None:
    """Write an interval from `{min: 0, max: 100}`."""
    parts = dict(re.findall(rf"(\w+): ({_PLAIN})", match[0]))
    low, high = (next((parts[name] for name in names if name in parts), None) for names in _ENDS)
    return "an interval is written low..high: `0..100`" if low is None or high is None else f"{{key}}: {low}..{high}"


_ENDS = (("min", "low", "from", "minimum"), ("max", "high", "to", "maximum"))


def _interval(match: re.Match[str]) -> str | None:
    interval = suggest_interval(match[0])
    return interval and f"{{key}}: {interval}"


def _bits(match: re.Match[str]) -> str:
    low, high = sorted((int(match[1]), int(match[2])))
    return f"{{key}}: {high}..{low}"


def _mapping(row: Callable[[int, str], str]) -> Callable[[re.Match[str]], str]:
    """Return a hint that writes a list as a mapping: `row` returns the row of an item by its index and text."""

    def write(match: re.Match[str]) -> str:
        rows = (row(index, item) for index, item in enumerate(match[1].split(", ")))
        return f"{{key}}: {{{', '.join(rows)}}}"

    return write


def _numbered_names(match: re.Match[str]) -> str:
    """Write `0=off, 1=on` as a mapping."""
    return f"{{key}}: {{{', '.join(f'{number}: {_snake(name)}' for number, name in _PAIRS.findall(match[0]))}}}"


def _snake(text: str) -> str:
    return re.sub(r"[^a-z0-9]+", "_", text.strip().lower()).strip("_") or "name"


def _comparisons(match: re.Match[str]) -> str:
    return f"{{key}}: {match[1].replace(': ', ' == ').replace(', ', ' and ')}"


def _decimals(match: re.Match[str]) -> str:
    return f"it counts the digits after the point: write `decimals: {len(match[1])}`"


def _bytes(match: re.Match[str]) -> str | None:
    """Write bytes from a list of numbers, or from hexadecimal text with markers or commas."""
    if match[0][0] == "[":
        numbers = [int(number) for number in match[0][1:-1].split(", ") if number.isdecimal()]
        whole = len(numbers) == match[0].count(",") + 1 <= 32 and max(numbers) < 256
        return f"{{key}}: {' '.join(f'{byte:02X}' for byte in numbers)}" if whole else None
    words = [re.sub(r"^(0[xX]|\$)|[hH]$", "", word) for word in re.split(r"[\s,;:]+", match[0])]
    whole = all(re.fullmatch(r"[0-9A-Fa-f]{1,2}", word) for word in words)
    return f"{{key}}: {' '.join(word.upper().zfill(2) for word in words)}" if whole else None


def _factor(match: re.Match[str]) -> str:
    """Write the scale that a bare factor stands for; both scales if it may multiply or divide."""
    number = Decimal(match[1])
    if number == 0:
        return "a factor of zero makes every value 0: write the rule, as in `{key}: value = raw * 0.1`"
    if number == 1:
        return "the raw number is the value: leave `{key}` out"
    scale = f"write the rule: `{{key}}: {exact_scale(f'value = raw * {number:f}')}`"
    if number < 1 or number % 1:
        return scale
    return f"{scale}, or `{{key}}: value = raw / {number:f}` if the raw number is the larger one"


def _words(match: re.Match[str]) -> str:
    """Suggest how a text, and what has no type, says how many words it takes."""
    return f"a text has `characters: {2 * int(match[0])}`, bytes and `untyped` words have `length: {match[0]}`"


def _family(match: re.Match[str]) -> str | None:
    """Suggest a family for a name with an addition, such as a framing; or say that the family is not known yet."""
    from fieldscribe.families import families

    known, text = families(), match[0].lower()
    near = next((each for each in known if text.startswith(each.name) and not each.lays_out_messages), None)
    if near is not None:
        has_framing = "framings" in near.bus.needed and len(text) > len(near.name)
        framings = f"; {' and '.join(near.framings)} are `framings` under `bus`" if has_framing else ""
        return f"write `family: {near.name}`{framings}"
    if text in ("canopen", "j1939", "nmea2000", "devicenet"):
        makers = " and ".join(each.name for each in known if each.lays_out_messages)
        return f"the family {makers} is for a maker's own messages, laid out byte by byte; this one is not known yet"
    return None


Hint = str | Callable[[re.Match[str]], str | None]

VALUES: tuple[tuple[str, str, Hint], ...] = (
    *(("type", f"{ours}|{names}", f"write `type: {ours}`{also}") for ours, names, also in _TYPES),
    *(
        (
            "type",
            f"(?:{ours}|{names}){_WORD_ORDER}",
            f"write `type: {ours}`; the order of words goes under `words`{also}",
        )
        for ours, names, also in _TYPES
    ),
    ("type", r"(?:u|uint|unsigned)(24|40|48|56)(?:_t)?", r"write `type: u\1`"),
    ("type", r"(?:s|i|int|sint|signed)(24|40|48|56)(?:_t)?", r"write `type: s\1`"),
    ("type", "int|integer", "write `type: s16` or `type: s32`"),
    ("type", "date|date[_ ]?time|clock", "a date has no type: write its parts, such as `parts: [year, month, day]`"),
    ("type", "ipv6|eui64|version", r"write `type: bytes` with `notation: \g<0>`"),
    (
        "type",
        r"[usi]?(?:int)?128(?:_t)?",
        "no number here has so many bits: write `type: bytes` with `length: 8`",
    ),
    ("type", "(?:.*[^a])?bcd.*", "write `type: u16` (u32, u48, ...) and `coding: bcd`"),
    ("coding", "packed|packed[-_ ]bcd|bcd[0-9]+", "{key}: bcd"),
    ("coding", "sign[-_ /]magnitude|sign[-_ ]and[-_ ]magnitude|signed magnitude", "{key}: sign and magnitude"),
    ("range range_in_units units pzd", r"\{.*\}", _ends),
    ("range range_in_units units pzd", rf"\[({_PLAIN}), ({_PLAIN})\]", r"{key}: \1..\2"),
    ("range range_in_units units pzd", r"[^\[\]{}]+", _interval),
    ("bits", r"\[([0-9]+), ([0-9]+)\]", _bits),
    ("bytes", r"\[.+\]|[0-9]*[^0-9\[\]{}][^\[\]{}]*", _bytes),
    ("unit", _DECIMAL, "a unit is a symbol such as `Hz`: `fieldscribe units` lists them; a factor belongs to `scale`"),
    ("unit", rf"\[({_PLAIN})\]", r"{key}: \1"),
    ("when", rf"\{{(\w+: {_PLAIN}(?:, \w+: {_PLAIN}){{0,3}})\}}", _comparisons),
    ("printed", r"(?!true|false)[^\[\]{}]{1,59}", _WHICH_NUMBER),
    ("line", r"([0-9]{1,9})\s*(?:-|\.\.|,|to).*", r"write the line where it begins: `line: \1`"),
    ("index", r".*\.\..*", r"several are `indices: \g<0>`"),
    ("set", r".*\.\..*", r"several are `sets: \g<0>`"),
    ("sets", r"\[.*\]", "write a count, or each with its row: `sets: 4`, `sets: {2: {at: \u2026}}`"),
    ("digits", r"-?[0-9]+", "{key}: {count: \\g<0>, enum: \u2026}"),
    (
        "special",
        rf"\[?((?:{_CODE})(?:, (?:{_CODE})){{0,7}})\]?",
        _mapping(lambda index, code: f"{code}: name_of_it{f'_{index + 1}' if index else ''}"),
    ),
    ("scale rule", rf"({_DECIMAL})", _factor),
    ("scale rule", rf"\{{.*?\b(?:factor|gain|slope|multiplier): ({_DECIMAL}).*\}}", _factor),
    ("scale rule", r"\{.*\}", "a scale is one formula, as in `{key}: value = raw * 0.1 - 40`"),
    ("enum flags", rf"\[({_WORD}(?:, {_WORD}){{0,7}})\]", _mapping(lambda index, name: f"{index}: {_snake(name)}")),
    ("values", _LIST, _mapping(lambda _, name: f"{name}: {{}}")),
    ("enum flags values special", r"[^\[\]{}]*[-+]?[0-9]+\s*[=:]\s*[A-Za-z][^\[\]{}]*", _numbered_names),
    ("steps", _DECIMAL, r"write `steps: {0: \g<0>}`: from raw 0 on"),
    ("decimals", r"[-+]?[0-9]*\.([0-9]*?)0*", _decimals),
    ("default", r"[-+]?[0-9]+\.[0-9]+", r"it is a raw number; a value in the unit is `default_in_units: \g<0>`"),
    ("source", r"[^\[\]{}]{1,60}", 'write `source: {document: \u2026, section: "\\g<0>"}`'),
    ("at", rf"\{{number: ({_PLAIN})\}}", r"{key}: \1"),
    (
        "at",
        rf"\{{number: ({_PLAIN}), ((?:sets|indices|set|index): [^{{}}]+)\}}",
        r"write `at: \1`, and `\2` beside it",
    ),
    ("at", r"\{((?:sets|indices|set|index): [^{}]+)\}", "write `at: \u2026`, and `\\1` beside it"),
    ("functions exceptions responses", _LIST, _mapping(lambda _, code: f"{code}: name_of_it")),
    ("family", r"[^\[\]{}]+", _family),
    ("group", r"\{.*?\bname: (\w+).*\}", r"write `group: \1` and its other keys below, at the top"),
    ("access", "ro|read|readonly|read[-_ ]only|r/o|true", "{key}: r"),
    ("access", "r/w|readwrite|read[-_ /]write|wr|w/r", "{key}: rw"),
    ("access", "wo|write|writeonly|write[-_ ]only|w/o", "{key}: w"),
    ("access", "-|no|n/a|false|reserved", "{key}: none"),
    ("words bytes", "big|be|big endian|abcd|high|msw first|hi lo|normal", "{key}: high first"),
    ("words bytes", "dcba", "write `words: low first` and `bytes: low first`"),
    ("words bytes", "badc", "write `bytes: low first`"),
    ("words bytes", "little|le|little endian|cdab|low|lsw first|lo hi|swap|swapped", "{key}: low first"),
    ("words", "[0-9]+", _words),
    ("keeps", "eeprom|flash|nvram|permanent", "{key}: yes"),
    ("keeps", "ram|volatile", "{key}: no"),
    (
        "keeps",
        "(?-i:[a-z][a-z0-9_]*)",
        r"write no, yes or choice; the command that keeps what is written is named as `keep_with: \g<0>`",
    ),
    ("changes", "constant|const|static|once|no|false", "{key}: never"),
    ("changes", "slow|sometimes|seldom|settings", "{key}: rarely"),
    ("changes", "fast|often|cyclic|live|yes|true", "{key}: always"),
    ("direction", "read|write|task|query|command|master", "{key}: request"),
    ("direction", "reply|answer|slave", "{key}: response"),
    ("direction", "broadcast|periodic|event", "{key}: cyclic"),
    ("certainty", "sure|high|yes|true|100%", "{key}: certain"),
    ("certainty", "probable|probably|medium|guess", "{key}: likely"),
    ("certainty", "low|unsure|no|false|open", "{key}: unknown"),
    *(("language", name, f"{{key}}: {code}") for name, code in LANGUAGES.items()),
    ("space", "hr|4x|holding[_ ]registers?|register", "{key}: holding"),
    ("space", "ir|3x|input[_ ]registers?", "{key}: input"),
    ("space", "do|0x|coils|output|digital_output", "{key}: coil"),
    ("space", "di|1x|discrete[_ ]inputs?|digital_input", "{key}: discrete"),
    ("active", "low|false|inverted|0", "{key}: 0"),
    ("active", "high|true|1", "{key}: 1"),
    ("open reserved no_value writable", "1", "{key}: yes"),
    ("open reserved no_value writable", "0", "{key}: no"),
    ("encoding", "utf_?8", "{key}: utf-8"),
    ("encoding", "utf_?16|ucs-?2", "{key}: utf-16"),
)
"""Keys, a pattern of the whole value (upper and lower case are the same), and what to write instead.

A mapping or list is matched as YAML in braces or brackets. A hint that starts with `{key}: ` is the line to write.
"""

_SCALE = "a scale is one formula: `scale: value = raw {} {}`"
_WIDTH = "the `type` says how wide a number is (u16, u32, ...), `characters` how long a text is"
_FUNCTION = "the `space` says what is read and written; function codes stand under `functions` of the `bus`"
_NO_VALUE = "write `special: {7FFFh: {name: not_available, no_value: yes}}`"
_SERIAL = "settings of the line stand together: `serial: {baud: 9600}`"
_ORDER = "the order of words is `words: high first` or `words: low first`, that of bytes in words `bytes: low first`"

KEYS: Mapping[str, tuple[str, str]] = {
    name: (ours, hint)
    for names, ours, hint in (
        ("address adress addr register reg wire", "at", ""),
        ("write_address write_register write_reg write_start written_at set_address", "write_at", ""),
        ("offset", "at", "an address is `at`; what is added to a number stands in its rule: `scale: value = raw - 40`"),
        ("scaling formula conversion", "scale", ""),
        ("factor gain multiplier mult coefficient slope scale_factor resolution step lsb", "scale", "*"),
        ("divisor divider div", "scale", "/"),
        ("limits values valid_range allowed", "range", ""),
        ("min max minimum maximum min_value max_value", "range", "both ends are one range: `range: low..high`"),
        ("datatype data_type format encoding_type dtype", "type", ""),
        ("size len count quantity width nwords word_count", "type", _WIDTH),
        ("takes words", "length", ""),
        ("byte_order byteorder endianness endian word_order wordorder swap byteswap", "words", _ORDER),
        ("description label text desc caption", "title", ""),
        ("comment comments remark remarks info help", "note", ""),
        ("choices options states map mapping lookup value_map values_map enumeration", "enum", ""),
        ("bitfield bitmask bitmap bit_names alarms", "flags", ""),
        ("bit bit_offset start_bit bitpos mask", "bits", ""),
        ("id number short_name tag", "code", ""),
        ("rights mode permission permissions", "access", ""),
        ("readonly read_only ro", "access", "write `access: r`"),
        ("writable writeable read_write rw writable_register", "access", "write `access: rw`"),
        ("writeonly write_only wo", "access", "write `access: w`"),
        ("eu uom units unit_of_measurement dimension", "unit", ""),
        ("default_value initial factory preset", "default", ""),
        ("poll polling interval scan_rate refresh update", "changes", ""),
        ("precision digits_after_point decimal_places", "decimals", ""),
        ("table register_type reg_type area object_type", "space", ""),
        ("function function_code fc read_function", "space", _FUNCTION),
        ("persistent persistence storage eeprom nonvolatile", "keeps", ""),
        ("alias aliases old_name former", "was", ""),
        ("no_value invalid nan missing na_value special_codes", "special", _NO_VALUE),
        ("inverted invert negated active_low low_active", "active", "write `active: 0`"),
        ("slave slave_id unit_id slave_address address_range node_id", "units", ""),
        ("baud baudrate parity stopbits stop_bits", "serial", _SERIAL),
        ("manufacturer maker brand", "vendor", ""),
        ("product device_model type_name", "model", ""),
        ("device_id", "device", ""),
        ("protocol bus_type", "family", ""),
        ("registers", "points", ""),
        ("name section groups", "group", ""),
        ("then expression", "rule", ""),
        ("if condition case", "when", ""),
        ("reason because", "why", ""),
        ("used corrected correct", "taken", ""),
    )
    for name in names.split()
}
"""Keys of other tools in lower case: our key, and a hint where the key alone does not help."""


def value_hint(key: Any, value: Any) -> str | None:
    """Return the hint for a wrong value of a key; None if there is no suggestion."""
    text = _flow(value)
    if not isinstance(key, str) or len(text) > _LONGEST:
        return None
    for keys, pattern, hint in VALUES:
        match = re.fullmatch(pattern, text, re.IGNORECASE) if key in keys.split() else None
        line = None if match is None else hint(match) if callable(hint) else match.expand(hint)
        if line is not None:
            line = f"write `{line}`" if line.startswith("{key}: ") else line
            return line.replace("{key}", key)
    return None


def _flow(value: Any) -> str:
    """Return a value as YAML on one line, without its quotes."""
    if isinstance(value, Map):
        return f"{{{', '.join(f'{key}: {_flow(item)}' for key, item in value.items())}}}"
    if isinstance(value, Seq):
        return f"[{', '.join(map(_flow, value))}]"
    return str(value).lower() if isinstance(value, bool) else str(value).strip()


def space_hint(space: str, known: Collection[str]) -> str | None:
    """Return the hint for a space under a name of other tools; None if there is no suggestion."""
    hint = value_hint("space", space)
    return hint if hint is not None and any(hint == f"write `space: {name}`" for name in known) else None


def key_suggestion(key: str, value: Any, known: Collection[str]) -> str | None:
    """Return the hint for a key of other tools; None if there is no suggestion."""
    ours, hint = KEYS.get(key.lower().replace("-", "_"), ("", ""))
    if ours == "range" and isinstance(value, Map) and "enum" in known:
        return "did you mean `enum`?"  # such as `values: {0: off}`
    if ours not in known:
        is_title = key.lower() in ("title", "label", "description", "text") and "quantity" in known
        return "titles stand beside the name, by language: `{name: off, en: Off}`" if is_title else None
    if hint in ("*", "/"):
        is_number = isinstance(value, int | Decimal) and not isinstance(value, bool)
        hint = _SCALE.format(hint, f"{value:f}" if isinstance(value, Decimal) else value) if is_number else ""
    if ours == "access" and value is False:
        hint = ""  # such as `read_only: false`: which other access is meant is unknown
    return hint or f"did you mean `{ours}`?"


def suggest_interval(text: str) -> str | None:
    """Return `0-100`, `0 to 100` or `[0:100]` in our notation; None if it is no interval."""
    ends = _INTERVAL.fullmatch(text.strip()) if len(text) <= _LONGEST else None
    if ends is None or number_in(ends[1]) is None or number_in(ends[2]) is None:
        return None
    return f"{ends[1]}..{ends[2]}"


def suggest_bits(text: str) -> str | None:
    """Return `15:8`, `b3` or `bit 3` in our notation; None if it is something else, or right already."""
    match = re.fullmatch(r"[^\W\d]{0,5}[ .]?([0-9]{1,2})(?:(?:-|:|,|/| to )([0-9]{1,2}))?", text.strip())
    if match is None or text.strip().isdecimal():
        return None
    ends = sorted((int(bit) for bit in match.groups() if bit), reverse=True)
    return "..".join(map(str, ends))


def reversed_hint(key: str, value: Any) -> str | None:
    """Return the hint for `off: 0` where the number belongs first; None if the value is no number."""
    if isinstance(value, int) and not isinstance(value, bool) and len(key) <= _LONGEST:
        return f"the number stands first: `{value}: {key.lower().replace(' ', '_')}`"
    return None
