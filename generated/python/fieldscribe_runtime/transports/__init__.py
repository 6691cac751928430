# SPDX-License-Identifier: 0BSD
"""Transports that people have, each a module of its own, imported when it is needed.

| module | what | needs |
|---|---|---|
| `tcp` | a Modbus device or gateway in a network, by a plain socket | nothing |
| `serial` | a serial line, Modbus RTU and USS | pyserial: `pip install "fieldscribe-runtime[serial]"` |
| `pymodbus` | a client of pymodbus that you have already | `fieldscribe-runtime[pymodbus]` |
| `can` | a bus of python-can | `fieldscribe-runtime[can]` |

Each has a class for devices and one for their async twins. All are context managers, raise TimeoutError when nothing
answers and LineError when the line itself fails, and may be shared by the devices (and threads) of one line.
"""
