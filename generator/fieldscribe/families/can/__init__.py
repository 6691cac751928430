"""The CAN family: a maker's own messages, laid out byte by byte in the description, and multiplexed telegrams."""

from fieldscribe.families.can.frames import LENGTH, CanFrame, Parsed, build, checksum, identifier, parse
from fieldscribe.families.can.receiver import Receiver

__all__ = ["LENGTH", "CanFrame", "Parsed", "Receiver", "build", "checksum", "identifier", "parse"]
