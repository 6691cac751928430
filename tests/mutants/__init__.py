"""Mutants: one thing changed at a time in what is generated, in the runtimes, in the descriptions and in the compiler.

A mutant that nothing notices shows what the conformance vectors, or the checks, the audit and the second readings, or
the tests of the compiler do not cover. It is measured on demand and is in no gate:

    make mutants                                300 a language and of the descriptions, 100 a room of the compiler
    make mutants ONLY=c COUNT=60 SEED=7         fewer, of one language, others
    make mutants ONLY=descriptions              needs the manuals' texts in FIELDSCRIBE_MANUALS
    make mutants ONLY=generator ROOM=resolve    of some rooms; a room is a folder of the compiler

It prints what was killed by kind of file and each survivor with its place, before and after, and ends with 1 if a mark
is missed. Each result is stored in `.cache/mutants`, by the seed and a digest of all that was judged: a run that was
stopped goes on where it was, and a larger COUNT starts where the smaller one ended.

In C and Rust, mutants inside of functions are built into one program a device, which chooses one when it runs. Those
of the compiler meet the tests of their room first; only what survives those needs the other tests measured, once.

What is changed: numbers, operators, names in strings, neighbouring constants, truth, named constants, statements and
conditions; in the compiler also what is returned, arguments that change places, comparisons and parts of conditions.
What is not: comments, heads, docstrings, attributes, decorators, and texts with spaces, which are for people, nor
what states that something cannot be (`assert`, `strict=True`). A mutant that does not compile or import is left out
of the count. `equivalent.jsonl` names the mutants that change nothing which can be seen, each with its reason.
"""
