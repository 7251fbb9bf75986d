"""Math functions: within the limits of the standard of what MPFR computes.

What they are and their limits are the rows of test/opencl/math/Functions.cpp, which a program of the build tells.
"""

import math
import os
import re
import subprocess

import numpy as np

from .columns import ROWS, specials
from .formats import Vector
from .units import componentwise, show

# Functions of less accuracy: half_ has a limit, and that of native_ is up to the device.
LESS = re.compile(r"(half|native)_(\w+)")
LESS_LIMIT = 8192
# Angles of these are the device's choice beyond 2^16.
ANGLES, MOST_ANGLE = ("sin", "cos", "tan"), 2.0**16
WITHOUT_NAME = {"divide": "x / y", "recip": "REAL(1) / x"}


class Oracle:
    """The program, and the rows that each function has: (number, limits by size)."""

    def __init__(self, program):
        # pylint: disable-next=consider-using-with
        self.process = subprocess.Popen([program], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.rows = {}
        for number, line in enumerate(iter(self.process.stdout.readline, b"\n")):
            expression, *limits = line.decode().rstrip("\n").split("\t")
            self.rows.setdefault(expression, []).append((number, dict(zip((2, 4, 8), map(float, limits)))))

    def rows_of(self, name):
        """Rows of a function's first result, or none."""
        calls = (f"{name}(x)", f"{name}(x, y)", f"{name}(x, WHOLE(y))", f"{name}(x, y, z)", f"{name}(x, &ignored)",
                 WITHOUT_NAME.get(name))
        return next((self.rows[c] for c in calls if c in self.rows), [])

    def ask(self, request, numbers, answered):
        self.process.stdin.write(request.encode() + b"\n" + np.asarray(numbers, np.float64).tobytes())
        self.process.stdin.flush()
        return np.frombuffer(self.process.stdout.read(8 * answered), np.float64)

    def arguments(self, row, size, count):
        return self.ask(f"arguments {size} {row} {count}", [], 3 * count).reshape(count, 3)

    def errors(self, row, size, cases):
        """(error, what is right) of each case: x, y, z and a result."""
        return self.ask(f"errors {size} {row} {len(cases)}", cases, 2 * len(cases)).reshape(-1, 2).tolist()


_oracle = None


def oracle():
    global _oracle  # pylint: disable=global-statement
    if not _oracle:
        _oracle = Oracle(os.path.join(os.environ["VORION_ROOT"], "bin", "opencl_math_reference"))
    return _oracle


def lgamma_sign(x):
    """Of the gamma function; None where there is none."""
    if not math.isfinite(x) or (x <= 0 and x == math.floor(x)):
        return None
    return 1 if x > 0 or math.floor(x) % 2 == 0 else -1


def judged(rows, size, limit_for, arguments, got):
    """Lines for results that err more than the limit. Of each of the rows there are ROWS."""
    lines = []
    for part, row in enumerate(rows):
        chosen = range(part * ROWS, (part + 1) * ROWS)
        cases = [([float(v) for v in arguments[k]] + [0.0, 0.0])[:3] + [got[k]] for k in chosen]
        for k, (error, right) in zip(chosen, oracle().errors(row, size, cases)):
            limit = limit_for(arguments[k], right)
            if not error <= limit:
                lines.append(f"({', '.join(map(show, arguments[k]))}) gave {show(got[k])}, not {show(right)}: {error} ulp")
    return lines


def limit_of(name, table_limit):
    """Takes arguments and what is right, gives the limit."""
    less = LESS.fullmatch(name)

    def limit(arguments, right):
        if less:
            strange = (less[2] in ANGLES and not abs(arguments[0]) <= MOST_ANGLE)
            extreme = less[1] == "native" and not all(2.0**-60 < abs(a) < 2.0**60 for a in (*arguments, right))
            return math.inf if strange or extreme else LESS_LIMIT
        if name.startswith("lgamma"):
            # No limit is given. Near its zeros the error is large in units of the result's last place.
            return 64 * max(1.0, 1 / abs(right)) if right and math.isfinite(right) else 0
        return table_limit

    return limit


def unit(overload):
    name = overload.name
    less = LESS.fullmatch(name)
    plain = less[2] if less else {"lgamma_r": "lgamma"}.get(name, name)
    rows = oracle().rows_of(plain)
    kinds = overload.kinds()
    if not rows or any(not Vector.known(n) for n, _ in kinds):
        return None
    kind = Vector(overload.result).element
    size = kind.bits // 8
    table = np.concatenate([oracle().arguments(row, size, ROWS) for row, _ in rows])
    values = [Vector(n).element for n, space in kinds if space is None]
    table = [table[:, n].tolist() for n in range(len(values))]
    for n, value in enumerate(values):
        if not value.real:
            source = specials(value)
            table[n] = [source[k // 8 % len(source)] if k % 8 == 0 else int(v) for k, v in enumerate(table[n])]
    limit = limit_of(name, rows[0][1][size])
    numbers = [row for row, _ in rows]

    def results(arguments, outputs):
        lines = judged(numbers, size, limit, arguments, outputs[0])
        if name == "sincos":
            other, limits = oracle().rows["(sincos(x, &ignored), ignored)"][0]
            lines += judged([other] * len(numbers), size, limit_of(name, limits[size]), arguments, outputs[1])
        if name == "lgamma_r":
            wanted = [lgamma_sign(row[0]) for row in arguments]
            lines += [f"({show(row[0])}) gave the sign {got}, not {want}"
                      for row, got, want in zip(arguments, outputs[1], wanted) if want and got != want]
        return lines

    return componentwise(overload, table, None, results=results)
