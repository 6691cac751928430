"""The words that heads of columns are made of, in English and German manuals, and what they say a column holds."""

from __future__ import annotations

import re

ROLES = (
    "code",
    "name",
    "address",
    "space",
    "bits",
    "type",
    "length",
    "access",
    "range",
    "least",
    "greatest",
    "step",
    "unit",
    "default",
    "formula",
    "description",
)
"""What a column may hold."""

_OF_ADDRESSES = (
    r"modbus|modicon|register|reg|start|can|bus|wire|protocol|protokoll|data|daten|mb|plc|holding|input|parameter|coil|"
    r"speicher|wort|discrete|object|io"
)
_BEHIND_ADDRESSES = r"nr|no|nummer|number|hex|dec|dez|dezimal|decimal|hexadezimal|hexadecimal|adresse|address|modbus"
_WORDS = {
    "step": (
        r"auflösung|resolution|res|step( size)?|schritt(weite)?|increment|inkrement|lsb|(min(imum)? )?setting unit|"
        r"scale|scaling|skalierung|faktor|factor|scale factor|skalierungsfaktor|multiplikator|multiplier|"
        r"umrechnungsfaktor"
    ),
    "step or default": r"grundwert|base value|basiswert",
    "default": (
        r"default( value| setting)?|werks?einstellung|factory( setting| default)?|initial( value| setting)?|ab werk|"
        r"vorgabewert|grundeinstellung|standardwert|standard"
    ),
    "least": r"min(imum|imal|\.)?( value|wert)?|lower limit|untergrenze|minimalwert",
    "greatest": r"max(imum|imal|\.)?( value|wert)?|upper limit|obergrenze|maximalwert",
    "formula": r"(berechnungs|umrechnungs)?formel|formula|conversion( formula)?|umrechnung",
    "access": (
        r"r ?/ ?w|r ?/ ?o|rw|w ?/ ?r|access( type| mode| right| rights)?|zugriff(sart|srecht)?|read ?/ ?write|"
        r"lesen ?/ ?schreiben|permission|attr(ibute)?s?|rights"
    ),
    "unit": r"units?|(maß|mess)?einheit(en)?|dim(ension)?|uom|eng(ineering)? units?",
    "type": r"(data |daten)?(typ|type|format)|datenart|variablentyp|art",
    "length": (
        r"(number|no|anzahl) (of |der )?(registers?|words|worte|wörter|register|wort)|length|länge|size|words|count|"
        r"qty"
    ),
    "bits": r"bits?( ?(nr|no|number|nummer|position|pos))?|bitnummer",
    "space": (
        r"(register|object|modbus|data) ?(type|table|area|space)|registertyp|tabelle|fc|function codes?|"
        r"funktionscodes?|area|bereichstyp"
    ),
    "range": (
        r"(werte|einstell|daten|anzeige|zulässiger )?bereich|(setting |data |value |valid |adjustment |input )?"
        r"range( of (values|setting))?|limits?|valid values|grenz(en|werte)|gültige werte|min ?(/|\.\.+|-) ?max"
    ),
    "code": (
        r"(fkt|funktions|func(tion)?|par(am)?(eter)?|cmd|menu|menü)?[ -]?(code|nr|no|num|number|nummer)( ?nr)?|"
        r"kürzel|par|tag|kennung|mnemonic|symbol|p ?nr"
    ),
    "address": (
        rf"(({_OF_ADDRESSES})[ -]?)*(address|adresse|adr|addr|register|reg|offset|pnu|index|id|coil)"
        rf"([ -]?({_BEHIND_ADDRESSES}))*"
    ),
    "name": (
        r"(parameter|signal|register|point|function|variable|object|tag|data)?[ -]?"
        r"(name|titel|title|bezeichnung|label)|"
        r"funktion|function|parameter|signal(bezeichnung)?|variable|messwert|measurement|quantity|inhalt.*|content.*|"
        r"prozessdaten|process data|item|data|daten|meaning|bedeutung|value|wert|größe|setting|einstellung|begriff"
    ),
    "description": (
        r"beschreibung|descriptions?|bemerkung(en)?|remarks?|comments?|kommentar|notes?|erläuterung(en)?|details|"
        r"explanation|hinweise?|options|auswahl|values|werte|information|anmerkung(en)?|enum(eration)?|wertebedeutung"
    ),
}
"""For each role the heads that say it, whole; the first fitting row wins."""

_ROLES = tuple((role, re.compile(words)) for role, words in _WORDS.items())
_BESIDE = re.compile(r"\[[^\]]*\]|\([^)]*\)|\{[^}]*\}")
_SIGNS = re.compile(r"[.:;*#_,\s-]*[.:;*#_,\s]+[.:;*#_,\s-]*")
_HEX, _DECIMAL = re.compile(r"\bhex|0x|\(h\)"), re.compile(r"\bde[zc]")
_UNIT = re.compile(r"[\[(]([^\[\]()]{1,12})[\])]")
MOST_HEAD = 60
"""A head is no longer than this; a longer cell is text."""


def role_of(head: str) -> str | None:
    """What a column with this head holds; None if the words say nothing."""
    if len(head) > MOST_HEAD:
        return None
    plain = head.casefold().replace("-\n", "").replace("\n", " ")
    for text in (plain, _BESIDE.sub(" ", plain)):
        words = _SIGNS.sub(" ", text).strip(" -/")
        role = next((role for role, pattern in _ROLES if words and pattern.fullmatch(words)), None)
        if role is not None:
            return role
    return None


def base_of(head: str) -> int | None:
    """The base that a head gives for its numbers: 16 or 10."""
    plain = head.casefold()
    return 16 if _HEX.search(plain) else 10 if _DECIMAL.search(plain) else None


def unit_in(head: str) -> str:
    """What stands in brackets in a head: perhaps a unit."""
    bracketed = _UNIT.search(head)
    return bracketed[1].strip() if bracketed else ""
