"""Files on disk: planned for a whole device, written atomically, only if they changed, and only over our own files.

Nothing outside the output folder is ever touched, whatever a manifest or a link in the folder says.
"""
