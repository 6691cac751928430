"""What people ask of a device: what frames say, how a value is sent, what is known of a point. All families share it.

What must be known of one family is the `Conversation` that its folder offers, see `family.py`.
"""
