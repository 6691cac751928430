"""Delivers a device, or chosen points of it, to a project: exactly the files that the project needs."""
