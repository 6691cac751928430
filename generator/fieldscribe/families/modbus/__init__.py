"""The Modbus family: spaces and functions, frames of RTU and TCP, and the batched reads that a device allows."""

from fieldscribe.families.modbus.blocks import plan_blocks
from fieldscribe.families.modbus.functions import (
    BROADCAST,
    FRAMINGS,
    FUNCTIONS,
    PROTOCOL_MOST,
    SPACES,
    Profile,
    Space,
    framings_of,
    profile_of,
)
from fieldscribe.families.modbus.replies import Reply, parse_reply
from fieldscribe.families.modbus.requests import Request, build, crc16, frame, parse_request

__all__ = [
    "BROADCAST",
    "FRAMINGS",
    "FUNCTIONS",
    "PROTOCOL_MOST",
    "SPACES",
    "Profile",
    "Reply",
    "Request",
    "Space",
    "build",
    "crc16",
    "frame",
    "framings_of",
    "parse_reply",
    "parse_request",
    "plan_blocks",
    "profile_of",
]
