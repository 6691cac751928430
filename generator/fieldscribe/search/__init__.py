"""Lists and searches descriptions: summaries of devices, and words in everything that has a name."""
