"""Fieldscribe's own pages as HTML, and the index that searches them together with devices.

`texts` reads a page of Markdown, `links` leads from page to page, `devices` has what the index says of a device,
`site` lays out the files; `vendoring/requests.py` requests them.
"""
