"""A family for one test: bells that answer each letter with a number. It is a folder, and one line in the registry."""
