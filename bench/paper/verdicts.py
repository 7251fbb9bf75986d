"""Verdicts: whether a figure of the paper holds here, computed by a stated rule."""

import statistics

HOLDS, IF, NOT = "holds", "holds if", "does not hold"
DEPENDS, NOT_COMPARABLE = "depends on the core", "not comparable"
# "About": within this factor.
FACTOR = 2


def at_least(number):
    return lambda value: value >= number


def about(number):
    return lambda value: number / FACTOR <= value <= number * FACTOR


def place(row):
    return f"{row['scene']} {row['view']}"


def by_machine(rows):
    """The rows of each machine, in the order in which the machines come."""
    found = {}
    for row in rows:
        found.setdefault(row.get("machine", ""), []).append(row)
    return found


def _on_one(rows, value, good):
    right = [good(value(row)) for row in rows]
    return HOLDS if all(right) else IF if any(right) else NOT


def verdict(rows, value, good, rate=False, condition="the view is"):
    """The verdict on rows of one machine, or of several that have the two cores.

    NOT if no view reaches the figure; DEPENDS if some view of one machine does and none of the other. Else NOT_COMPARABLE for
    a rate: it is the workload's, and of the paper's nobody knows the size of the pictures and the number of Gaussians, so
    that a smaller one than ours would have reached it, too. Of other figures HOLDS if every view reaches it, else IF with
    the views that do."""
    kinds = [_on_one(of, value, good) for of in by_machine(rows).values()]
    if NOT in kinds:
        return NOT if set(kinds) == {NOT} else DEPENDS
    if rate:
        return NOT_COMPARABLE
    if set(kinds) == {HOLDS}:
        return HOLDS
    return f"{IF} {condition} " + "; ".join(_named(machine, of, value, good) for machine, of in by_machine(rows).items())


def _named(machine, rows, value, good):
    right = sorted((row for row in rows if good(value(row))), key=value, reverse=True)
    if len(right) == len(rows):
        shown = "any"
    else:
        shown = ", ".join(map(place, right[:3])) + (f" or {len(right) - 3} others" if len(right) > 3 else "")
    return shown + (f" on `{machine}`" if machine else "") + f" ({len(right)} of {len(rows)})"


def span(rows, value, unit=""):
    """The smallest, the median and the largest value of each machine, with their views."""
    said = []
    for machine, of in by_machine(rows).items():
        low, high = min(of, key=value), max(of, key=value)
        shown = f"{value(low):.3g}{unit} ({place(low)})"
        if len(of) > 1:
            shown += f" to {value(high):.3g}{unit} ({place(high)}), median {statistics.median(map(value, of)):.3g}{unit}"
        said.append((f"`{machine}` " if machine else "") + shown)
    return "; ".join(said)


def ratios(rows, value, paper):
    return f"{min(map(value, rows)) / paper:.2f} to {max(map(value, rows)) / paper:.2f}"


def claim(what, paper, rows, value, good, *, unit="", number=None, bound="", rate=False, condition="the view is", reads=None):
    """A claim about a figure of each view, or None if no view was measured. number: the paper's, for the ratio. rate:
    whether the figure is one that a workload has."""
    if not rows:
        return None
    best = max(rows, key=value)
    return {
        "claim": what,
        "paper": paper,
        "verdict": verdict(rows, value, good, rate, condition),
        "ours": span(rows, value, unit),
        "ratio": ratios(rows, value, number) if number else "",
        "bound": bound,
        "command": (reads or best).get("command", ""),
    }
