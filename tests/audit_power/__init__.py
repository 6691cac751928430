"""How many changes of a manual the audit reports: facts of a description, changed one at a time where they are cited."""
