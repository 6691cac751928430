"""Simulated devices: made from the model alone, they hold numbers, obey the rules of the manual and answer a bus.

    layout      which words of which area each point takes, found chains laid out: one for all devices of a kind
    memory      the words of one device; points are read from them, so that views, twins and bit groups always agree
    starting    a plausible raw number for each point at the start
    device      a memory with the rules: access, ranges, conditions, commands, what survives a restart
    clock       the time of the devices, which may run faster or stand still
    core        what the part `simulation` of a family offers: it cuts bytes into requests, and answers them
    faults      what can happen to an answer on its way
    line        devices that share a line: requests in, answers with faults and delays out, and the trace
    servers     sockets, serial lines and CAN buses around a line
    bench       the file that lists many devices on many lines
    library     `simulated("hitachi_l200")`, for tests

A behaviour file moves the numbers: `behaviour` implements `device.Behaviour`.
"""

from fieldscribe.simulation.library import Simulated as Simulated
from fieldscribe.simulation.library import simulated as simulated
