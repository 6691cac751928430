"""Files on disk: planned for a whole device, written only if they changed, atomically, and only over files of our own.

Nothing outside the output folder is ever touched, whatever a manifest or a link in the folder says.
"""
