# SPDX-License-Identifier: 0BSD
"""Transports that people have, each a module of its own, imported when it is needed.

| module | what | needs |
|---|---|---|
| `tcp` | a Modbus device or gateway in a network, by a plain socket | nothing |
| `serial` | a serial line, Modbus RTU and USS | `pip install pyserial` |
| `pymodbus` | a client of pymodbus that you have already | `pip install pymodbus` |
| `can` | a bus of python-can | `pip install python-can` |

Each has a class for devices and one for their async twins. All are context managers, raise TimeoutError when nothing
answers and LineError when the line itself fails, and may be shared by the devices (and threads or tasks) of one line:
those of bytes carry one question with its answer at a time, on a CAN bus every device hears all frames. What they are
made with is checked: RequestError (bad_transport, bad_mode, bad_framing) says what is taken.
"""
