#include "raster/Reciprocals.h"

#include <array>

namespace vorion::raster {

namespace {

constexpr std::string_view ThreeOfEach =
    "three multipliers and three adders [paper], the fourth multiplication in "
    "the pair's spare multiplier";

// The paper's units take 3 multiplications below 0.5 and 4 above, one after the
// other, and an addition each; three steps take 6. A pair of lanes has one
// multiplier to spare (docs/rasterizer.md, "The backward mode"). An exact
// divider has 26 bits to find, one before the point that may be 0 and one to
// round by, 3 or 4 a cycle. Latencies are our estimates.
constexpr std::array<ReciprocalUnit, ReciprocalCount> Units{{
    {0, "exact", 8, 0, 1,
     "a divider, an fp32 multiplier with 26 subtractions of 24 bits in place "
     "of the product, and registers; ours",
     0x1p-23, "T / (1 - alpha), correctly rounded"},
    {1, "even-left", 6, 8 * 24, 3, ThreeOfEach, 0.5462,
     "Taylor to alpha^4 below 0.5; above, two Newton-Raphson steps from 8 "
     "entries evenly spaced in alpha, exact at their left ends"},
    {2, "even-best", 6, 8 * 24, 3, ThreeOfEach, 0.3230,
     "the same with the entries' best seeds"},
    {3, "log-left", 6, 8 * 24, 3, ThreeOfEach, 0.0313,
     "Taylor to alpha^4 below 0.5; above, two Newton-Raphson steps from 8 "
     "entries evenly spaced in log(1 - alpha), exact at their left ends"},
    {4, "log-best", 6, 8 * 24, 3, ThreeOfEach, 0.0313,
     "the same with the entries' best seeds"},
    {5, "mantissa-2", 5, 8 * 24, 3, ThreeOfEach, 1.25e-5,
     "8 entries by the mantissa of 1 - alpha, two Newton-Raphson steps"},
    {6, "mantissa-3", 7, 8 * 24, 5,
     "six multiplications, in five multipliers and the pair's spare one, and "
     "three adders; ours",
     1.7e-7,
     "8 entries by the mantissa of 1 - alpha, three Newton-Raphson "
     "steps"},
}};

} // namespace

std::span<const ReciprocalUnit> reciprocalUnits() { return Units; }

} // namespace vorion::raster
