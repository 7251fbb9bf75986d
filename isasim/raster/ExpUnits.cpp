#include "raster/ExpUnits.h"

namespace vorion::raster {

static constexpr ExpUnit Units[ExpUnitCount] = {
    {.Option = VR_EXP_EXACT,
     .Name = "correctly-rounded",
     .MaxRelativeError = 0x1p-24,
     .Explanation = "exp: the nearest fp32 number for every input; the "
                    "yardstick that no small unit reaches"},
    {.Option = VR_EXP_TABLE,
     .Name = "table",
     .MaxRelativeError = 2.85e-4,
     .Explanation =
         "exp: 2^x from 16 linear segments in 16-bit fixed point; exact at 0, "
         "never rises as its argument falls, no subnormal results"},
    {.Option = VR_EXP_POLY2,
     .Name = "poly2",
     .MaxRelativeError = 2.7e-3,
     .Explanation = "exp: 2^x by a polynomial of degree 2 in fp32; exact at 0, "
                    "no subnormal results"},
    {.Option = VR_EXP_POLY3,
     .Name = "poly3",
     .MaxRelativeError = 1.1e-4,
     .Explanation = "exp: 2^x by a polynomial of degree 3 in fp32; exact at 0, "
                    "no subnormal results"},
    {.Option = VR_EXP_POLY4,
     .Name = "poly4",
     .MaxRelativeError = 7.2e-6,
     .Explanation = "exp: 2^x by a polynomial of degree 4 in fp32; exact at 0, "
                    "no subnormal results"},
    {.Option = VR_EXP_TABLE32,
     .Name = "table32",
     .MaxRelativeError = 8.3e-5,
     .Explanation =
         "exp: 2^x from 32 linear segments in 17-bit fixed point; exact at 0, "
         "never rises as its argument falls, no subnormal results"},
    {.Option = VR_EXP_TABLE64,
     .Name = "table64",
     .MaxRelativeError = 2.65e-5,
     .Explanation =
         "exp: 2^x from 64 linear segments in 18-bit fixed point; exact at 0, "
         "never rises as its argument falls, no subnormal results"},
    {.Option = VR_EXP_LINEAR,
     .Name = "linear",
     .MaxRelativeError = 5.7e-3,
     .Explanation = "exp: 2^x from four linear pieces an octave whose slopes "
                    "are sums of two powers of two; exact at 0, no "
                    "multiplication by a slope, no subnormal results"},
    {.Option = VR_EXP_SCHRAUDOLPH,
     .Name = "schraudolph",
     .MaxRelativeError = 3.1e-2,
     .Explanation = "exp: the result's bits are a linear function of the "
                    "argument; 2.2 % low at 0, no subnormal results"},
};

std::span<const ExpUnit> expUnits() { return Units; }

} // namespace vorion::raster
