#!/bin/sh
# Sets up what `make generate` (compiler) or `make test` (tests) needs: a virtual environment in .venv and, for the tests,
# the compilers of the target languages. As root on Debian it installs what is missing; elsewhere it names it.
set -eu
cd "$(dirname "$0")/.."
purpose=${1:-compiler}

missing_packages=""
need() { # command, Debian packages
    command -v "$1" >/dev/null 2>&1 || missing_packages="$missing_packages $2"
}
need_that() { # Debian packages, then the command line that succeeds where they are there
    packages=$1
    shift
    "$@" >/dev/null 2>&1 || missing_packages="$missing_packages $packages"
}
has_file() { # any of these files
    for file in "$@"; do
        if [ -e "$file" ]; then return 0; fi
    done
    return 1
}
links() { # a compiler with its options: can it make a program? What is installed may lack a library that is not.
    made=$(mktemp -d)
    printf 'int main(void) { return 0; }\n' >"$made/empty.c"
    code=0
    "$@" "$made/empty.c" -o "$made/empty" || code=$?
    rm -rf "$made"
    return "$code"
}

clang_libraries() { # the package with the sanitizer's library, of the version that is installed or would be
    version=$(clang -dumpversion 2>/dev/null) || version=14
    echo "libclang-rt-${version%%.*}-dev"
}

need python3 python3
if command -v python3 >/dev/null 2>&1 && [ ! -x .venv/bin/python ]; then
    python3 -c 'import ensurepip, venv' >/dev/null 2>&1 || missing_packages="$missing_packages python3-venv"
fi
if [ "$purpose" = tests ]; then
    need_that "gcc libc6-dev" links gcc -fsanitize=address,undefined
    need_that "g++ libc6-dev" links g++ -x c++
    need_that "clang $(clang_libraries)" links clang -fsanitize=address,undefined
    need arm-none-eabi-gcc gcc-arm-none-eabi
    need qemu-system-arm qemu-system-arm
    need make make
    need ninja ninja-build
    need cmake cmake
    need meson meson
    need avr-gcc "gcc-avr avr-libc"
    need_that gcc-multilib links gcc -m32
    need_that libnewlib-arm-none-eabi has_file /usr/lib/arm-none-eabi/include/stdint.h /usr/include/newlib/stdint.h
    need_that libmodbus-dev has_file /usr/include/modbus/modbus.h
    need cargo "cargo-web rustc-web"
    need frama-c frama-c-base
    need cppcheck cppcheck
    need rustfmt rustfmt-web
    need cargo-clippy rust-web-clippy
    need zsh zsh
    need fish fish
    need node nodejs
    need npm npm
    need soffice libreoffice-calc-nogui
    need chromium-headless-shell chromium-headless-shell
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
    # one that was interrupted has a python but no pip
    .venv/bin/python -m pip --version >/dev/null 2>&1 || python3 -m venv .venv
    .venv/bin/python -m pip install --quiet --disable-pip-version-check --editable ".$extra"
    echo "$wanted" >.venv/installed
fi

firmware=thumbv6m-none-eabi
if [ "$purpose" = tests ] && command -v rustup >/dev/null 2>&1 && [ ! -d "$(rustc --print target-libdir --target $firmware 2>/dev/null)" ]; then
    if [ "$(id -u)" = 0 ]; then
        echo "setting up $firmware for rustc"
        timeout 300 rustup target add $firmware >/dev/null 2>&1 || echo "rustup could not add $firmware: the test that needs it is skipped" >&2
    else
        echo "missing here: rustup target add $firmware" >&2
    fi
fi

# what the tests take from npm, each at a version: editors, types, packages and pages are tried with the real tools
from_npm="yaml-language-server@1.25.0 typescript@5.9.3 @types/node@20 playwright-core@1.65.1 axe-core@4.14.1
publint@0.3.25 @arethetypeswrong/cli@0.18.5 esbuild@0.28.2 modbus-serial@8.0.25 serialport@13.0.0"
if [ "$purpose" = tests ] && [ "$(cat .cache/node/installed 2>/dev/null)" != "$from_npm" ] && command -v npm >/dev/null 2>&1; then
    echo "setting up packages of npm in .cache"
    mkdir -p .cache/node
    system_certificates=/etc/ssl/certs/ca-certificates.crt # npm brings its own and knows none that a firm added
    [ -f "$system_certificates" ] && export npm_config_cafile="$system_certificates"
    # without them some tests are skipped, which say so; the rest needs no network
    # shellcheck disable=SC2086 # a list of packages
    if timeout 300 npm install --fetch-retries=1 --prefix .cache/node --no-save --no-package-lock --no-audit --no-fund --silent $from_npm; then
        echo "$from_npm" >.cache/node/installed
    else
        echo "npm could not install $from_npm: the tests that need them are skipped" >&2
    fi
fi
