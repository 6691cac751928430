"""What people ask of a device: what frames say, how a value is sent, what is known of a point. All families share it.

What depends on the family is in the parts `speech`, `sending` and `explaining` of its folder.
"""
