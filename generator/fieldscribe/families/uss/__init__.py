"""The USS family: telegrams with a parameter part (PKW) and process data (PZD)."""

from fieldscribe.families.uss.telegrams import (
    DOUBLE_RESPONSES,
    LAST_PARAMETER,
    START,
    VARIABLE,
    Link,
    Reply,
    Request,
    broadcast,
    build,
    check_byte,
    parameter_words,
    parse,
    telegram,
    write_task,
)

__all__ = [
    "DOUBLE_RESPONSES",
    "LAST_PARAMETER",
    "START",
    "VARIABLE",
    "Link",
    "Reply",
    "Request",
    "broadcast",
    "build",
    "check_byte",
    "parameter_words",
    "parse",
    "telegram",
    "write_task",
]
