"""What targets know of bells: only the vectors do."""
