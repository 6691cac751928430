"""The errors for a request that cannot be fulfilled, and hints with near names."""

from fieldscribe.text import line


class UnclearError(Exception):
    """The device does not have what the user named, or has several of them; `hint` may be empty."""

    def __init__(self, message: str, hint: str = "") -> None:
        super().__init__(message)
        self.message = message
        self.hint = hint
        if hint:
            self.add_note(f"hint: {hint}")  # tests of users see it


class RefusedError(Exception):
    """A value must not be sent. `status` is that of generated code, or `missing`, `read_only` and the like.

    `why` is the message without the name of the point.
    """

    def __init__(self, status: str, message: str, hint: str = "", *, why: str = "") -> None:
        super().__init__(message)
        self.status = status
        self.message = message
        self.hint = hint
        self.why = why or message


def did_you_mean(names: list[str]) -> str:
    """Return a hint that offers near names; empty if there are none."""
    return f"did you mean {either(names)}?" if names else ""


def either(names: list[str]) -> str:
    """Return names as a choice, each marked as code."""
    return " or ".join(f"`{line(name)}`" for name in names)


def can_package(interface: str, error: Exception) -> str:
    """Return how to install the package that an interface of python-can lacks; empty for any other error."""
    if not ("not installed" in str(error) or isinstance(error, ImportError)):
        return ""
    from importlib.metadata import metadata

    extra = "multicast" if interface == "udp_multicast" else interface.replace("_", "-")
    known = metadata("python-can").get_all("Provides-Extra") or ()
    return f"pip install 'python-can[{extra}]'" if extra in known else ""
