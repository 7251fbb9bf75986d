"""Verdicts: whether a figure of the paper holds here, by the share of the trials in which it does."""

import math
import statistics
from dataclasses import dataclass

HOLDS, NOT, OPEN = "holds", "does not hold", "open"
# The share of the trials from which on a claim holds, and up to which it does not.
MOST, LEAST = 0.95, 0.05
CONFIDENCE = 0.95  # of a share's interval
# "About": within this factor.
FACTOR = 2


@dataclass(frozen=True)
class Trial:
    """A figure of ours beside one of the paper's. kind: what of several was measured ("serial", a baseline); where: a view; gaussians:
    of the frame or iteration, 0 if that does not matter."""
    value: float
    where: str
    kind: str = ""
    machine: str = ""
    command: str = ""
    gaussians: int = 0


def at_least(number):
    return lambda value: value >= number


def about(number):
    return lambda value: number / FACTOR <= value <= number * FACTOR


def below(number):
    return lambda value: value < number


def place(row):
    return f"{row['scene']} {row['view']}"


def wilson(held, count, confidence=CONFIDENCE):
    """Wilson's interval of a share, `held` of `count` trials."""
    z = statistics.NormalDist().inv_cdf((1 + confidence) / 2)
    share, square = held / count, z * z / count
    middle = (share + square / 2) / (1 + square)
    half = z / (1 + square) * math.sqrt(share * (1 - share) / count + square / (4 * count))
    return max(0.0, middle - half), min(1.0, middle + half)


def verdict(held, count):
    """By the share alone: its interval stands beside it."""
    return HOLDS if held >= MOST * count else NOT if held <= LEAST * count else OPEN


def share_text(held, count, of):
    low, high = wilson(held, count)
    return f"{held} of {count} {of}, {100 * low:.0f}-{100 * high:.0f} %"


def interval(values):
    """5 %, median and 95 %; of fewer than three values the least and the largest."""
    if len(values) < 3:
        return min(values), statistics.median(values), max(values)
    cuts = statistics.quantiles(values, n=20, method="inclusive")
    return cuts[0], statistics.median(values), cuts[-1]


def interval_text(values, unit=""):
    low, middle, high = interval(values)
    return f"{shown(middle)}{unit} ({shown(low)} to {shown(high)})"


def shown(value):
    """Three digits, without an exponent."""
    return f"{value:.3g}" if abs(value) < 1000 else f"{value:.0f}"


def span(trials, unit=""):
    """The smallest, the median and the largest value of each machine, with their views."""
    said, by_machine = [], {}
    for trial in trials:
        by_machine.setdefault(trial.machine, []).append(trial)
    for machine, of in by_machine.items():
        low, high = (pick(of, key=lambda trial: trial.value) for pick in (min, max))
        text = f"{shown(low.value)}{unit} ({low.where})"
        if len(of) > 1:
            middle = statistics.median(trial.value for trial in of)
            text += f" to {shown(high.value)}{unit} ({high.where}), median {shown(middle)}{unit}"
        said.append((f"`{machine}` " if machine else "") + text)
    return "; ".join(said)


def ratios(trials, paper):
    return f"{min(t.value for t in trials) / paper:.2f} to {max(t.value for t in trials) / paper:.2f}"
