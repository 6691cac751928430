"""The CAN family: a maker's own messages, laid out byte by byte in the description, and multiplexed telegrams."""
