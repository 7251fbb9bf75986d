"""Latin hypercubes, some of whose factors follow each other."""

import math
import random
import statistics


def parts(keys, count, seed, correlations=()):
    """For each of `count` draws a part of 0 to 1 by key: of each key, each of `count` equal parts is used once.
    correlations: (key, key, rank correlation); two keys that none of them connects are independent."""
    rng = random.Random(seed)
    columns = {}
    for key in keys:
        column = [(n + rng.random()) / count for n in range(count)]
        rng.shuffle(column)
        columns[key] = column
    for block in _connected(keys, correlations):
        columns.update(_correlated({key: columns[key] for key in block}, correlations))
    return [{key: column[n] for key, column in columns.items()} for n in range(count)]


def value_at(domain, part):
    """A domain's value at `part` of it, 0 to 1: one of a list of choices, or between two ends, even in the logarithm."""
    if isinstance(domain, list):
        return domain[int(part * len(domain))]
    low, high = domain
    return round(low * (high / low) ** part)


def ranks(values):
    """From 0 on; equal values have the mean of their ranks."""
    order = sorted(range(len(values)), key=lambda n: values[n])
    place = [0.0] * len(values)
    at = 0
    while at < len(order):
        end = at
        while end < len(order) and values[order[end]] == values[order[at]]:
            end += 1
        for n in order[at:end]:
            place[n] = (at + end - 1) / 2
        at = end
    return place


def rank_correlation(a, b):
    """Spearman's, or 0 if one of the two is constant."""
    return statistics.correlation(ranks(a), ranks(b)) if len(set(a)) > 1 and len(set(b)) > 1 else 0.0


def is_beyond_chance(correlation, count):
    """Whether a rank correlation of `count` draws is not that of independent ones, at 99 %."""
    return abs(correlation) >= 2.6 / math.sqrt(count)


def _connected(keys, correlations):
    """The sets of keys that correlations connect, each in the order of `keys`."""
    block_of = {key: {key} for key in keys}
    for a, b, _ in correlations:
        if a in block_of and b in block_of and block_of[a] is not block_of[b]:
            joined = block_of[a] | block_of[b]
            block_of.update(dict.fromkeys(joined, joined))
    blocks = {id(block): block for block in block_of.values() if len(block) > 1}
    return [[key for key in keys if key in block] for block in blocks.values()]


def _correlated(columns, correlations):
    """The columns in other orders, so that their ranks correlate as wanted (Iman and Conover, 1982): each stays a permutation
    of itself."""
    keys, count = list(columns), len(next(iter(columns.values())))
    normal = statistics.NormalDist()
    scores = [[normal.inv_cdf((rank + 1) / (count + 1)) for rank in ranks(columns[key])] for key in keys]
    wanted = _matrix(keys, correlations)
    # Scores whose correlation is what chance gave become some without any, and these what is wanted. Few draws keep that of chance:
    # with no more draws than factors no order is without any.
    there = _matrix(keys, ()) if count < 2 * len(keys) else [[statistics.correlation(a, b) if a is not b else 1.0 for b in scores] for a in scores]
    lower_there, lower_wanted = _cholesky(there), _cholesky(wanted)
    mixed = [[0.0] * count for _ in keys]
    for n in range(count):
        free = _solved(lower_there, [row[n] for row in scores])
        for k, row in enumerate(lower_wanted):
            mixed[k][n] = sum(weight * free[j] for j, weight in enumerate(row[:k + 1]))
    return {key: [sorted(columns[key])[int(rank)] for rank in ranks(row)] for key, row in zip(keys, mixed)}


def _matrix(keys, correlations):
    matrix = [[float(a == b) for b in keys] for a in keys]
    for a, b, value in correlations:
        if a in keys and b in keys:
            i, j = keys.index(a), keys.index(b)
            matrix[i][j] = matrix[j][i] = value
    return matrix


def _cholesky(matrix):
    """The lower triangle whose product with its transpose is the matrix."""
    lower = [[0.0] * len(matrix) for _ in matrix]
    for i, row in enumerate(matrix):
        for j in range(i + 1):
            rest = row[j] - sum(lower[i][k] * lower[j][k] for k in range(j))
            if i == j and rest <= 0:
                raise ValueError("no variables have these correlations, expected a positive definite matrix")
            lower[i][j] = math.sqrt(rest) if i == j else rest / lower[j][j]
    return lower


def _solved(lower, right):
    """x of lower x = right."""
    x = []
    for row, value in zip(lower, right):
        x.append((value - sum(weight * known for weight, known in zip(row, x))) / row[len(x)])
    return x
