"""The arguments that functions are tried with: values where something changes, and random ones of fixed seeds."""

import itertools
import math
import random

import numpy as np

# Divisible by all widths of vectors.
ROWS = 480


def specials(kind):
    """Values where something changes."""
    if kind.real:
        whole_from = 2.0**(kind.digits - 1)
        values = [0.0, kind.denormal, kind.normal - kind.denormal, kind.normal, 0.25, 0.5, 1.0 - 2.0**-kind.digits, 1.0,
                  1.0 + 2.0**(1 - kind.digits), 1.5, 2.0, 2.5, 3.0, 10.0, whole_from - 0.5, whole_from, whole_from + 1, kind.most,
                  math.inf]
        return [s * v for v in values for s in (1.0, -1.0)] + [math.nan]
    bits, most = kind.bits, kind.most
    values = [0, 1, 2, 3, bits - 1, bits, most, most - 1, most // 2, most // 2 + 1, most // 3,
              1 << bits // 2, (1 << bits // 2) - 1]
    if bits > 24:
        values += [2**23 - 1, 2**23, 2**24 - 1, 2**24]
    if kind.signed:
        values += [-v for v in values] + [kind.least, kind.least + 1]
    return sorted(set(values))


def halfway(kind):
    """Edges of all types, and what lies halfway between whole numbers: what conversions round or clamp."""
    edges = [0, 1, 2, 3, 127, 128, 255, 256] + [2**k + d for k in (11, 15, 16, 24, 31, 32, 53, 63, 64) for d in (-1, 0, 1)]
    edges += [65504, 65519, 65520, 65536, 2**24 - 2**12, 2**24 + 3, 2**25 + 2, 2**53 + 3, 2**54 - 2, 2**54 + 6]
    if not kind.real:
        return [e for v in edges for e in (v, -v) if kind.least <= e <= kind.most]
    values = [v + d for v in edges for d in (0, 0.25, 0.5, 0.75)]
    values += [2.0**-14, 2.0**-15, 2.0**-24, 2.0**-25, 3 * 2.0**-25, 2.0**-26, 2.0**-126, 2.0**-149, 2.0**-150, 3 * 2.0**-150,
               2.0**128, 2.0**128 - 2.0**103, 2.0**128 - 2.0**104, 1 + 2.0**-11, 1 + 3 * 2.0**-11, 1 + 2.0**-24, 1 + 3 * 2.0**-24]
    values = sorted({kind.rounded(float(v)) for v in values} - {math.inf})
    return [e for v in values for e in (v, -v)]


def drawn(kind, source):
    """A random value: any bit pattern, or one of an ordinary size."""
    if not kind.real:
        value = source.getrandbits(source.randint(1, kind.bits))
        return kind.wrapped(-value if source.random() < 0.5 else value)
    way = source.randrange(4)
    if way == 0:
        return kind.of_pattern(source.getrandbits(kind.bits))
    if way == 1:
        return source.randint(-200, 200) / 2
    value = 2.0**source.uniform(-30, 8) if way == 2 else source.random()
    return kind.rounded(source.choice((1, -1)) * value)


_known = {}


def columns(kinds, rows=ROWS, special=specials):
    """A column of values for each type: first a share of all combinations of special values, then random ones."""
    key = tuple(k.name for k in kinds), rows, special
    if key not in _known:
        source = random.Random(repr(key[:2]))
        sets = [special(k) for k in kinds]
        if math.prod(map(len, sets)) <= rows * 3 // 4:
            table = list(itertools.product(*sets))
        else:
            table = [tuple(source.choice(s) for s in sets) for _ in range(rows // 2)]
        while len(table) < rows:
            mixed = source.random() < 0.25
            table.append(tuple(source.choice(s) if mixed and source.random() < 0.5 else drawn(k, source)
                               for k, s in zip(kinds, sets)))
        source.shuffle(table)
        _known[key] = [list(column) for column in zip(*table)]
    return _known[key]


CONVERSION_ROWS = 2 * ROWS


def conversion_column(kind):
    column = (specials(kind) + halfway(kind))[:CONVERSION_ROWS]
    source = random.Random(kind.name)
    while len(column) < CONVERSION_ROWS:
        column.append(drawn(kind, source))
    return column


def stored(values, kind):
    """A column as it lies in memory."""
    with np.errstate(over="ignore", invalid="ignore"):
        return np.array(values, kind.storage)
