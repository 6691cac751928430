"""Files on disk: planned as a whole, written only if they changed, whole or not at all, and only over what is ours.

Nothing outside the output folder is ever touched, whatever a manifest or a link in the folder says.
"""
