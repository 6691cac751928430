"""Fieldscribe's own pages as HTML, and the index that searches them together with devices.

`texts` reads a page of Markdown; `site` resolves its links, builds the index and lays out the files, which
`vendoring/requests.py` requests.
"""
