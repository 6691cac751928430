#!/bin/sh
# The `rustdoc` of cargo: runs the examples of a crate, then checks its documentation, with all that cargo passes.
set -eu
case " $* " in *" --test "*) ;; *) exec rustdoc "$@" ;; esac
rustdoc "$@"
for word; do
    shift
    [ "$word" = --test ] || set -- "$@" "$word"
done
RUSTC_BOOTSTRAP=1 exec rustdoc "$@" -Zunstable-options --check -Dwarnings # only an unstable option leaves the pages out
