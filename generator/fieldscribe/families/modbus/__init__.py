"""The Modbus family: spaces and functions, frames of RTU and TCP, and the batched reads that a device allows."""
