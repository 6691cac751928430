"""How many changes of a manual the audit reports: facts of a description, each changed where it is printed."""
