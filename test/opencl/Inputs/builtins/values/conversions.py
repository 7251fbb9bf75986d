"""convert_*: from the definition, with exact rationals."""

import math
import re
from fractions import Fraction

from .columns import conversion_column
from .formats import NEAREST, TO_ZERO, Vector, rounded_to_whole
from .units import UNDEFINED, componentwise


def to_real(value, target, mode):
    return target.rounded(value, mode or NEAREST)


def to_whole(value, source, target, saturated, mode):
    if source.real:
        if math.isnan(value):
            return 0 if saturated else UNDEFINED
        if math.isinf(value):
            whole = target.most + 1 if value > 0 else target.least - 1
        else:
            whole = rounded_to_whole(Fraction(value), mode or TO_ZERO)
    else:
        whole = value
    if saturated:
        return target.clamped(whole)
    if source.real and not target.least <= whole <= target.most:
        return UNDEFINED
    return target.wrapped(whole)


def unit(overload):
    if not overload.name.startswith("convert_"):
        return None
    saturated, mode = re.fullmatch(r"convert_[a-z]+\d*(_sat)?(?:_(rt[ezpn]))?", overload.name).groups()
    (source,), target = overload.values(), Vector(overload.result).element

    def converted(value):
        if target.real:
            return to_real(value if source.element.real else Fraction(value), target, mode)
        return to_whole(value, source.element, target, saturated, mode)

    return componentwise(overload, [conversion_column(source.element)], converted)
