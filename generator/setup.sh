#!/bin/sh
# Sets up what `make generate` (compiler) or `make test` (tests) needs: a virtual environment in .venv and, for the tests,
# the compilers of the target languages. As root on Debian it installs what is missing; elsewhere it names it.
set -eu
cd "$(dirname "$0")/.."
purpose=${1:-compiler}

missing_packages=""
need() { # command or path, Debian package
    command -v "$1" >/dev/null 2>&1 || missing_packages="$missing_packages $2"
}

need python3 python3
if command -v python3 >/dev/null 2>&1 && [ ! -x .venv/bin/python ]; then
    python3 -c 'import ensurepip, venv' >/dev/null 2>&1 || missing_packages="$missing_packages python3-venv"
fi
if [ "$purpose" = tests ]; then
    need gcc gcc
    need g++ g++
    need clang "clang libclang-rt-14-dev"
    need arm-none-eabi-gcc gcc-arm-none-eabi
    need avr-gcc "gcc-avr avr-libc"
    echo "#include <stdio.h>" | gcc -m32 -fsyntax-only -x c - 2>/dev/null || missing_packages="$missing_packages gcc-multilib"
    [ -e /usr/lib/arm-none-eabi/include/stdint.h ] || [ -e /usr/include/newlib/stdint.h ] || missing_packages="$missing_packages libnewlib-arm-none-eabi"
    need cargo "cargo-web rustc-web"
    need rustfmt rustfmt-web
    need cargo-clippy rust-web-clippy
fi

if [ -n "$missing_packages" ]; then
    if [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null 2>&1; then
        echo "installing:$missing_packages"
        export DEBIAN_FRONTEND=noninteractive
        apt-get update -qq
        # shellcheck disable=SC2086 # a list of package names
        apt-get install -y -qq --no-install-recommends $missing_packages >/dev/null
    else
        echo "missing here:$missing_packages" >&2
        echo "on Debian: sudo apt-get install$missing_packages" >&2
        echo "tests that need them are skipped" >&2
    fi
fi

python3 -c 'import sys; sys.exit(sys.version_info < (3, 11))' || {
    echo "Fieldscribe needs Python 3.11 or later; this is $(python3 --version)" >&2
    exit 2
}

extra=""
[ "$purpose" = tests ] && extra="[test]"
wanted="$extra $(cksum <pyproject.toml)"
if [ "$purpose" = compiler ] && [ -x .venv/bin/fieldscribe ] && [ -f .venv/installed ]; then
    # a test environment can do all that the compiler's can
    case "$(cat .venv/installed)" in *"$(cksum <pyproject.toml)") exit 0 ;; esac
fi
if [ ! -x .venv/bin/python ] || [ ! -f .venv/installed ] || [ "$(cat .venv/installed)" != "$wanted" ]; then
    echo "setting up .venv"
    [ -x .venv/bin/python ] || python3 -m venv .venv
    .venv/bin/python -m pip install --quiet --disable-pip-version-check --editable ".$extra"
    echo "$wanted" >.venv/installed
fi
