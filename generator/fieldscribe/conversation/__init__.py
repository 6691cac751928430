"""The questions of users: what frames mean, how a value is sent, what is known of a point. All families share it.

The modules, in the order in which they build on each other:

- `lookup`, `selection`: the points and variants that a user names
- `refusals`, `meanings`: why a number is refused; a raw number into words
- `encoding`: a typed value into a raw number and frames, or the reason why not
- `explanation`: all facts of a point, and of everything else
- `point_items`: the item of a raw number, and doubts about it
- `decode_state`, `address_items`, `telegram_items`, `decoder`: frames into results

The parts `frame_decoder` and `frame_builder` of a family's folder have what depends on the family.
"""
