"""What each target knows of the family: one module for each."""
