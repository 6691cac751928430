"""The keys of behaviour.yaml: what a simulated device does."""

from __future__ import annotations

from fieldscribe.language.keys import forms
from fieldscribe.language.keys.places import BEHAVIOUR
from fieldscribe.language.keys.shapes import A_NAME, TITLE
from fieldscribe.schema_types import BOOLEAN, NUMBER, Items, Key, Place, Shape, Text, by

_QUANTITY = Place(before=(NUMBER,)).means("One quantity.", [{"start": 40, "unit": "%"}])
_MOVE = Shape("A move.", ["set 1 while external_trip == trip"], Text(2000))

KEYS = (
    Key("behaviour", BEHAVIOUR, "The device that it belongs to.", required=True).takes(["hitachi_l200"], A_NAME),
    Key(
        "plant",
        BEHAVIOUR,
        "Quantities that no point holds, by name: of the machine, its surroundings, or a state inside the device.",
    ).takes([{"load": {"start": 40, "unit": "%"}, "emergency_stop": 0}], by(forms.NAME, _QUANTITY.shape)),
    Key("start", _QUANTITY, "What it is when the simulation starts; 0 unless it is another number.").takes(
        [40], NUMBER
    ),
    Key("unit", _QUANTITY, "Its unit.").takes(["%"], Text(20)),
    Key("title", _QUANTITY, TITLE),
    Key(
        "start",
        BEHAVIOUR,
        "What points hold when the simulation starts, in the unit or as the name of an enum entry. Other points hold "
        "their default, or a plausible number.",
    ).takes(
        [{"F002": 10.0, "A001": "network"}],
        by(forms.ANY, Shape("The value in the unit, or a name.", [10.0], Text(80), NUMBER, BOOLEAN)),
    ),
    Key(
        "moves",
        BEHAVIOUR,
        "What points and quantities do, by name, code, or `point.flag`: one move or several. Of those whose condition "
        "holds (`while`), the first one counts; without one, the number stays. `when` happens once, each time that its "
        "condition becomes true.",
        required=True,
    ).takes(
        [
            {
                "output_frequency": "ramp to A020 at 10 Hz/s while run_command == run",
                "alarm": ["set 1 while external_trip == trip after 2 s", "set 0 while trip_reset == reset"],
                "trip_count": "set trip_count + 1 when alarm == tripped",
            }
        ],
        by(forms.ANY, Shape("What it does.", ["set load"], Text(2000), Items(_MOVE, 1)), least=1),
    ),
)
