"""The entry point of the command `fieldscribe`, and of `python -m fieldscribe`."""

_INTERRUPTED = 130


def main() -> int:
    """Run the command line and return its exit code, also if Ctrl-C comes while its modules are imported."""
    try:
        from fieldscribe.cli import main as run

        return run()
    except KeyboardInterrupt:
        return _INTERRUPTED


if __name__ == "__main__":
    raise SystemExit(main())
