"""Arguments of Python as words of splat's command line, which checks them."""

import numbers
import os

from ._machine import UsageError


def path_bytes(path):
    """The name of a file as the system has it, of a str, bytes or a path."""
    name = os.fsencode(path)
    if b"\0" in name:  # the system would take it for the part before
        raise UsageError(f"{path!r}: a NUL in the name, expected a name without one")
    return name


def _text(value):
    if isinstance(value, str):
        return value
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        return repr(float(value))  # so many digits that the same number is read
    return ",".join(_text(v) for v in value)


def words(options):
    """["--support=box3", ...] of {"support": "box3", ...}; None is for what is not asked for."""
    found = []
    for name, value in options.items():
        flag = "--" + name.replace("_", "-")
        if value is None:
            continue
        if isinstance(value, bool):
            found.append(f"{flag}={str(value).lower()}")
        else:
            found.append(f"{flag}={_text(value)}")
    return found
