"""Words that people know from other tools and languages as values, and our words for them."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping

TYPE_WORDS = {
    "bit": "bool boolean coil flag discrete bit1",
    "u8": "uint8 byte usint uchar unsigned8 unsigned_char uint8_t",
    "s8": "int8 i8 sint char signed8 signed_char int8_t",
    "u16": "uint16 word uint ushort unsigned unsigned16 uint16_t w register unsigned_short unsigned_int",
    "s16": "int16 i16 short signed signed16 int16_t sint16 signed_short signed_int",
    "u32": "uint32 dword udint ulong unsigned32 uint32_t unsigned_long",
    "s32": "int32 i32 dint long signed32 int32_t sint32 signed_long",
    "u64": "uint64 qword lword ulint unsigned64 uint64_t unsigned_long_long",
    "s64": "int64 i64 lint signed64 int64_t sint64 long_long signed_long_long",
    "f32": "float real float32 single ieee754",
    "f64": "double lreal float64",
    "text": "string str ascii char[] visible_string",
}
LANGUAGES = {"german": "de", "deutsch": "de", "english": "en", "french": "fr", "italian": "it", "spanish": "es"}
ENDIAN = re.compile(r"[-_ ]?(be|le|abcd|cdab|badc|dcba|swap(ped)?|big|little)$")
WORDS: Mapping[str, Mapping[str, str]] = {
    "type": {
        "int": "s16` or `type: s32",
        "integer": "s16` or `type: s32",
        "ieee": "f32",
        "enum": "u16",
        "bitfield": "u16",
    }
    | {word: ours for ours, words in TYPE_WORDS.items() for word in words.split()},
    "access": dict.fromkeys(("ro", "read", "readonly", "read-only", "read_only", "r/o", "true"), "r")
    | dict.fromkeys(("r/w", "readwrite", "read-write", "read_write", "read/write", "wr", "w/r"), "rw")
    | dict.fromkeys(("wo", "write", "writeonly", "write-only", "write_only", "w/o"), "w")
    | dict.fromkeys(("-", "no", "n/a", "false", "reserved"), "none"),
    "words": dict.fromkeys(("big", "be", "big endian", "abcd", "high", "msw first", "hi lo", "normal"), "high first")
    | dict.fromkeys(
        ("little", "le", "little endian", "cdab", "low", "lsw first", "lo hi", "swap", "swapped"), "low first"
    ),
    "keeps": dict.fromkeys(("eeprom", "flash", "nvram", "permanent"), "yes") | dict.fromkeys(("ram", "volatile"), "no"),
    "changes": dict.fromkeys(("constant", "const", "static", "once", "no", "false"), "never")
    | dict.fromkeys(("slow", "sometimes", "seldom", "settings"), "rarely")
    | dict.fromkeys(("fast", "often", "cyclic", "live", "yes", "true"), "always"),
    "direction": dict.fromkeys(("read", "write", "task", "query", "command", "master"), "request")
    | dict.fromkeys(("reply", "answer", "slave"), "response")
    | dict.fromkeys(("broadcast", "periodic", "event"), "cyclic"),
    "certainty": dict.fromkeys(("sure", "high", "yes", "true", "100%"), "certain")
    | dict.fromkeys(("probable", "probably", "medium", "guess"), "likely")
    | dict.fromkeys(("low", "unsure", "no", "false", "open"), "unknown"),
    "language": LANGUAGES,
    "space": dict.fromkeys(
        ("hr", "4x", "holding_register", "holding_registers", "holding register", "register"), "holding"
    )
    | dict.fromkeys(("ir", "3x", "input_register", "input_registers", "input register"), "input")
    | dict.fromkeys(("do", "0x", "coils", "output", "digital_output"), "coil")
    | dict.fromkeys(("di", "1x", "discrete_input", "discrete_inputs", "discrete input", "digital_input"), "discrete"),
    "active": dict.fromkeys(("low", "false", "inverted", "0"), "0") | dict.fromkeys(("high", "true", "1"), "1"),
    **{key: {"1": "yes", "0": "no"} for key in ("open", "reserved", "no_value", "writable")},
    "encoding": {"utf-8": "ascii` or `encoding: latin-1", "utf8": "ascii` or `encoding: latin-1"},
}
"""By key: our word for each foreign word in lower case."""

ALSO = {
    "bit": " in the space `coil` or `discrete`; one bit of a word is `bits: 0`, without a type",
    "u8": " with the `bits: 7..0` that it takes of its word, or `type: u16`",
    "s8": " with the `bits: 7..0` that it takes of its word, or `type: s16`",
    "text": " with `characters: …`",
}
"""What else a line with this type needs."""
