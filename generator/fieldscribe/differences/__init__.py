"""The differences between two models of a device, each with its class, and the step that the version must take.

Exported models are compared, so one side may be a description and the other a file of another version.
"""
