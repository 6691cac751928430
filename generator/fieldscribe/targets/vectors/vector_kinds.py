"""The table of all kinds of vectors, with the fields of their lines.

A file has lines of fields, separated by tabs. Its head names the device, then every set and every kind in it, with the
fields and their forms, so that no runner needs a list of its own. A set is what the vectors below it share until it is
set anew; it ends the sets that come after it in the table. An absent field is a hyphen, or left out at the end of a
line. A runner compares every field with something, except notes.

A row of the tables here has the fields of a line in order, each with its form; one that may be absent ends in a
question mark. `only` names the languages that have this in code and not only in comments; without it, all have it.
"""

_REQUEST = "framing:word unit:int transaction:int function:int address:int count:int values:ints?"

_EXCHANGE = "script:script status:word raw:int? words:ints? needs:script?"

SETS = {
    "unit": "unit:int framing:word?",
    "bases": "starts:pairs lasts:pairs",
    "link": "pkw:int pzd:int single_first:int?",
    "point": "point:word",
    "with": "with:pairs?",
    "request": _REQUEST,
    "message": "message:word",
    "telegram": "telegram:word unit:int",
    "task": "unit:int task:int parameter:int index:int width:int value:int words:ints?",
}
"""What vectors share: the unit, its line, bases of addresses, the point, what it needs, a request, message or task."""

KINDS = {
    # conversions between raw number, value (binary64) and count, and whether a raw number may be written
    "decode": "raw:int status:word value:real? special:word?",
    "encode": "value:real status:word raw:int?",
    "decode_count": "raw:int status:word count:int? special:word?",
    "encode_count": "count:int status:word raw:int?",
    "check": "raw:int status:word",
    # names of numbers, special codes, flags, and the numbers of flags of several bits
    "name": "raw:int name:text?",
    "special": "special:text low:int high:int",
    "special_name": "raw:int name:text? no_value:int?",
    "flag": "flag:text raw:int number:int truth:int?",
    "flag_name": "flag:text raw:int name:text",
    # bit groups out of their words and into them, words of a number, texts and digits
    "bits": "word:int raw:int replaced:int result:int",
    "words": "raw:int words:ints",
    "text_decode": "words:ints text:bytes?",
    "text_encode": "text:bytes? status:word words:ints?",
    "unicode_decode": "words:ints status:word text:bytes?",
    "unicode_encode": "text:bytes? status:word words:ints?",
    "bytes_decode": "only:c.rust words:ints bytes:bytes",
    "bytes_encode": "only:c.rust bytes:bytes words:ints",
    "notation": "only:python.typescript words:ints text:text",
    "digits": "raw:int status:word digits:ints? special:word?",
    "digits_encode": "digits:ints status:word raw:int?",
    # facts of a point apart from its conversions
    "address": "space:word address:int words:int code:text? raw_min:int? raw_max:int? decimals:int? references:pairs?",
    "place": "addresses:ints index:int? telegram:word?",
    "write_address": "only:c.rust address:int",
    "fixed": "mask:int bits:int",
    # whole exchanges with a point: requests, answers and result; also for writing permanently
    "read": _EXCHANGE,
    "write": _EXCHANGE,
    "store": _EXCHANGE,
    # facts that only Python has in code: in C and Rust they are comments, which no program can check
    "facts": "only:python.typescript group:word name:word type:word symbol:text? default:real? changes:word? "
    "changes_with:names? variant:text? only_for:names? keeps:word? conditions:names? write_space:word? "
    "write_addresses:ints?",
    # what identifies the device and its variants, each alternative alone
    "identification": "name:word of:word raw:int? text:text? variant:pairs?",
    # old names of a point
    "alias": "only:c.python.typescript old:word new:word",
    # the values of an axis of variants, and what is only documented
    "variant": "only:python.typescript axis:word choices:names",
    "left_out": "only:python.typescript names:names codes:names",
    # the number of decimals that people see, the date of a time as seconds after 1970-01-01, and the texts of values
    "display": "decimals:int",
    "epoch": "seconds:int",
    "told": "only:python.rust.typescript raw:int status:word text:text?",
    # the symbol of a point's unit
    "symbol": "only:rust symbol:text",
    # the addresses of points that are only documented
    "documented": "name:word space:word address:int words:int index:int?",
    # the reads of a group's words; not in Rust, which reads points one by one
    "group": "only:c.python.typescript group:word addresses:ints",
    # the contents of tables of constants: functions or tasks in order, limits, lengths of tables
    "function": "only:c index:int number:int most:int? broadcast:int? answers:int?",
    "limit": "only:c what:word number:int",
    "size": "only:c what:word of:text? number:int",
    # named numbers of the protocol, and commands
    "code": "what:word number:int name:text",
    "constant": "only:c.rust what:word number:int name:text",
    "command": "command:word value:int script:script status:word",
}
"""The kinds of vectors of all families: the fields of their lines. The sets in force apply to every line."""
