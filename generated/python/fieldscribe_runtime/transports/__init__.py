# SPDX-License-Identifier: 0BSD
"""Ready transports, each in a module of its own, imported when needed.

| module | what | needs |
|---|---|---|
| `tcp` | a Modbus device or gateway in a network, through a plain socket | nothing |
| `serial` | a serial line, Modbus RTU and USS | `pip install pyserial` |
| `pymodbus` | a client of pymodbus that you have already | `pip install pymodbus` |
| `can` | a bus of python-can | `pip install python-can` |

Each has a class for devices and one for async devices. All are context managers, raise TimeoutError when nothing
answers and LineError when the line itself fails, and can be shared by the devices (and threads or tasks) of one line:
lines of bytes do one exchange at a time, and on a CAN bus every device receives all frames. Invalid arguments raise
RequestError (bad_transport, bad_mode, bad_framing).
"""
