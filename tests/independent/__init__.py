"""A second, small reader of descriptions, and what it expects of the vectors. It imports nothing of the compiler.

The compiler resolves a description into a model, and the vectors are computed from that model: a slip on the way to it
would be repeated by all that follows. This reader takes the same YAML as plain texts and works out the answers in its
own way.
"""
