"""Passive listening: shows what masters and devices exchange, from a capture or a line, with names and units.

- `captures.py` opens a capture and returns its chunks: it takes packets apart, and joins the segments of a connection.
  `packet_files.py` reads pcap and pcapng, and writes pcapng.
- `chunks.py` has what all sources give, listens on a serial line, reads lines of a log, and cuts bytes into frames
  where only a check tells where a frame ends.
- A family's `lines.py` has its kinds of chunks (`KINDS`) and ports (`PORTS`), reads a line of a log (`chunk_of_text`),
  listens (`receive`), and cuts chunks into frames: `take` and `rest` of what `cutter` returns. `action` names what a
  frame does, `packet` writes it.
- `listener.py` gives each frame to the decoder of its device, and pairs requests with their answers.
- `exchanges.py` says what an exchange is, and counts who polls what, how often, and what is wrong.

Nothing here sends. Memory use does not grow with a capture, and any bytes are safe.
"""
