"""What differs between two models of a device: each difference classified, and the step that the version must take.

Models are compared as they are exported, so one side may be a description and the other a file of another version.
"""
