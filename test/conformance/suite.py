"""What the suites of tests have in common: a test is a command, and a function that says how it ended."""

import dataclasses
from collections.abc import Callable

# In the order of the table. "time": it ran into the limit.
OUTCOMES = ("passed", "skipped", "failed", "crashed", "time")


class Problem(Exception):
    pass


@dataclasses.dataclass(frozen=True)
class Test:
    """A run of a subtest, its command, and the files that it is made of. judge takes what the command wrote and its exit
    code, and gives the outcome and a reason. limit: seconds, unless the user gives others."""
    program: str
    name: str
    command: tuple[str, ...]
    files: tuple[str, ...]
    judge: Callable[[str, int], tuple[str, str]]
    limit: float = 600
