#include "raster/ExpUnits.h"

namespace vorion::raster {

// Latencies are for the timing model: the table unit's multiplications are
// small enough for one stage each, the other's are of 53 bits.
static constexpr ExpUnit Units[ExpUnitCount] = {
    {.Option = 0,
     .Name = "correctly-rounded",
     .LatencyCycles = 8,
     .TableBits = 0,
     .Multipliers = "16 of 53 x 53 bits",
     .MaxRelativeError = 0x1p-24,
     .Explanation = "exp: the nearest fp32 number for every input; the "
                    "yardstick that no small unit reaches"},
    {.Option = 1,
     .Name = "table",
     .LatencyCycles = 3,
     .TableBits =
         table_exp::Entries * (table_exp::StartBits + table_exp::DropBits),
     .Multipliers = "1 of 24 x 24 bits, 1 of 12 x 12 bits",
     .MaxRelativeError = 2.85e-4,
     .Explanation =
         "exp: 2^x from 16 linear segments in 16-bit fixed point; exact at 0, "
         "never rises as its argument falls, no subnormal results"},
};

std::span<const ExpUnit> expUnits() { return Units; }

} // namespace vorion::raster
