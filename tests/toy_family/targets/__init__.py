"""What targets know of bells: the documentation and the vectors do."""
