"""What a new description of bells starts with."""

SERVES = "bells"
DEVICE = """\
bus: {units: 1..4}
frames: [{name: ring_first, bytes: 31 41, says: {first: 0}}]
"""
GROUP = """\
group: tones
title: {en: Tones}
space: tone
access: w
source: {document: manual, section: "1"}
points:
- {name: first, at: 0, range: 0..9}
"""
