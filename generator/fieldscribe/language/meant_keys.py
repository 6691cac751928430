"""Keys that people know from other tools and languages, and the keys that mean the same here."""

from __future__ import annotations

from decimal import Decimal
from typing import TYPE_CHECKING, Any

from fieldscribe.language.keys import keys_of
from fieldscribe.language.keys.places import DEVICE, GROUP

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping

_SCALE = "a scale is one formula: `scale: value = raw {} {}`"
_SPACE = "the `space` says what is read and written; function codes stand under `functions` of the `bus`"
_WIDTH = "the `type` says how wide a number is (u16, u32, ...), `characters` how long a text is"
_ORDER = "the order of words is `words: high first` or `words: low first`; the bytes of a word have one order"
_GROUP = "a group is a part: `group: …`, `space: …` and `points: […]`, below a line `---` or in a file under `parts`"
_MEANT: Mapping[str, tuple[str, str]] = {
    word: (ours, hint)
    for ours, hint, words in (
        ("at", "", "address adress addr register reg wire"),
        ("write_at", "", "write_address write_register write_reg write_start written_at set_address"),
        ("at", "an address is `at`; what is added to a number stands in its rule: `scale: value = raw - 40`", "offset"),
        ("scale", "", "scaling formula conversion"),
        ("scale", "*", "factor gain multiplier mult coefficient slope scale_factor resolution step lsb"),
        ("scale", "/", "divisor divider div"),
        ("range", "", "limits values valid_range allowed"),
        ("range", "both ends are one range: `range: low..high`", "min max minimum maximum min_value max_value"),
        ("type", "", "datatype data_type format encoding_type dtype"),
        ("type", _WIDTH, "size len count quantity width bytes nwords word_count"),
        ("length", "", "takes words"),
        ("words", _ORDER, "byte_order byteorder endianness endian word_order wordorder swap byteswap"),
        ("title", "", "description label text desc caption"),
        ("note", "", "comment comments remark remarks info help"),
        ("enum", "", "choices options states map mapping lookup value_map values_map enumeration"),
        ("flags", "", "bitfield bitmask bitmap bit_names alarms"),
        ("bits", "", "bit bit_offset start_bit bitpos mask"),
        ("code", "", "id number short_name tag"),
        ("access", "", "rights mode permission permissions"),
        ("access", "write `access: r`", "readonly read_only ro"),
        ("access", "write `access: rw`", "writable writeable read_write rw writable_register"),
        ("access", "write `access: w`", "writeonly write_only wo"),
        ("unit", "", "eu uom units unit_of_measurement dimension"),
        ("default", "", "default_value initial factory preset"),
        ("changes", "", "poll polling interval scan_rate refresh update"),
        ("decimals", "", "precision digits_after_point decimal_places"),
        ("space", "", "table register_type reg_type area object_type"),
        ("space", _SPACE, "function function_code fc read_function"),
        ("keeps", "", "persistent persistence storage eeprom nonvolatile"),
        ("was", "", "alias aliases old_name former"),
        (
            "special",
            "write `special: {7FFFh: {name: not_available, no_value: yes}}`",
            "no_value invalid nan missing na_value special_codes",
        ),
        ("active", "write `active: 0`", "inverted invert negated active_low low_active"),
        ("units", "", "slave slave_id unit_id slave_address address_range node_id"),
        (
            "serial",
            "settings of the line stand together: `serial: {baud: 9600}`",
            "baud baudrate parity stopbits stop_bits",
        ),
        ("vendor", "", "manufacturer maker brand"),
        ("model", "", "product device_model type_name"),
        ("device", "", "device_id"),
        ("family", "", "protocol bus_type"),
        ("points", "", "registers"),
        ("group", "", "name section groups"),
        ("rule", "", "then expression"),
        ("when", "", "if condition case"),
        ("why", "", "reason because"),
        ("taken", "", "used corrected correct"),
    )
    for word in words.split()
}
"""By the foreign key in lower case: our key, and an explanation if the key alone does not help."""


def meant_key(key: str, value: Any, known: Collection[str]) -> str | None:
    """The hint what to write instead of a foreign key; None if there is no guess."""
    ours, hint = _MEANT.get(key.lower().replace("-", "_"), ("", ""))
    if "parts" in known and (key == "groups" or key in keys_of(GROUP)):
        return _GROUP
    if "group" in known and key in keys_of(DEVICE):
        return "this stands in the head of device.yaml, its first document"
    if ours == "range" and isinstance(value, dict) and "enum" in known:
        return "did you mean `enum`?"  # such as `values: {0: off}`
    if ours not in known:
        return _of_an_entry(key, known)
    if hint in ("*", "/"):
        plain = isinstance(value, int | Decimal) and not isinstance(value, bool)
        hint = _SCALE.format(hint, f"{value:f}" if isinstance(value, Decimal) else value) if plain else ""
    if ours == "access" and value is False:
        hint = ""  # such as `read_only: false`: which other access is meant is unknown
    return hint or f"did you mean `{ours}`?"


def _of_an_entry(key: str, known: Collection[str]) -> str | None:
    """The hint for a title beside the name of a number: titles there are by language."""
    if key.lower() in ("title", "label", "description", "text") and "quantity" in known:
        return "titles stand beside the name, by language: `{name: off, en: Off}`"
    return None
