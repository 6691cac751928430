"""What helps a person who writes a description: start one, keep it in form, compile it whenever it is saved."""
