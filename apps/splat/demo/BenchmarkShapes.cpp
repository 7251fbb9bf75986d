// Fitted to real scenes by bench/benchmark_fit.py over the figures of
// docs/tables/benchmark-set.md, which says how far each is off, and rounded to
// three digits.

#include "demo/BenchmarkScene.h"

#include <cstddef>

namespace vorion::splat::demo {

namespace {

// clang-format off
/// For 10,000, 100,000 and 1,000,000 Gaussians of each kind.
constexpr BenchmarkShape Shapes[3][3] = {
    {
        {.Distance = 1.8, .Second = 1.8, .Third = 1.8, .Behind = 0.624, .Nowhere = 0.324, .Back = 1.52, .Fading = 0.115, .Clumps = 0.766,
         .Size = 1.9, .SizeSpread = 0.25, .BlockSize = 0.193, .Stretch = 0.4, .Large = 0.101, .LargeSize = 1.1,
         .Depth = 0.423, .Opaque = 0.00842, .BlockOpaque = 0, .Most = 0.26, .Faint = 4.64, .BlockFaint = 0.226},
        {.Distance = 1.8, .Second = 1.8, .Third = 1.8, .Behind = 9.43, .Nowhere = 1.27, .Back = 1.64, .Fading = 0.171, .Clumps = 1.19,
         .Size = 1.54, .SizeSpread = 0.385, .BlockSize = 0.141, .Stretch = 1.05, .Large = 0.0742, .LargeSize = 1.59,
         .Depth = 0.449, .Opaque = 0.257, .BlockOpaque = 0, .Most = 0.882, .Faint = 4.47, .BlockFaint = 0.169},
        {.Distance = 1.05, .Second = 2.2, .Third = 1.5, .Behind = 4.5, .Nowhere = 0.268, .Back = 1.96, .Fading = 0.119, .Clumps = 1.7,
         .Size = 1.79, .SizeSpread = 0.251, .BlockSize = 0.0995, .Stretch = 1.53, .Large = 0.0998, .LargeSize = 1.1,
         .Depth = 0.353, .Opaque = 0.368, .BlockOpaque = 0, .Most = 0.865, .Faint = 3.37, .BlockFaint = 0.157},
    },
    {
        {.Distance = 1.8, .Second = 1.8, .Third = 1.8, .Behind = 0, .Nowhere = 0.0845, .Back = 2.15, .Fading = 4, .Clumps = 0.576,
         .Size = 0.697, .SizeSpread = 0.168, .BlockSize = 0.316, .Stretch = 1.36, .Large = 0.186, .LargeSize = 1.1,
         .Depth = 0.418, .Opaque = 0.505, .BlockOpaque = 0, .Most = 0.953, .Faint = 0.25, .BlockFaint = 0.14},
        {.Distance = 1.97, .Second = 1.95, .Third = 1.93, .Behind = 0.108, .Nowhere = 0.238, .Back = 1.66, .Fading = 4.34, .Clumps = 0.493,
         .Size = 0.898, .SizeSpread = 0.202, .BlockSize = 0.251, .Stretch = 2.2, .Large = 0.142, .LargeSize = 1.72,
         .Depth = 0.57, .Opaque = 0.42, .BlockOpaque = 0.282, .Most = 0.892, .Faint = 1.18, .BlockFaint = 0.0678},
        {.Distance = 1.15, .Second = 1.15, .Third = 1.15, .Behind = 1.32, .Nowhere = 0.669, .Back = 2.49, .Fading = 3.29, .Clumps = 0.394,
         .Size = 0.332, .SizeSpread = 1.18, .BlockSize = 0.149, .Stretch = 1.86, .Large = 0.0512, .LargeSize = 1.86,
         .Depth = 0.585, .Opaque = 0.456, .BlockOpaque = 0, .Most = 0.917, .Faint = 1.14, .BlockFaint = 0.26},
    },
    {
        {.Distance = 0.932, .Second = 0.932, .Third = 0.932, .Behind = 0.252, .Nowhere = 0, .Back = 0.664, .Fading = 0.0502, .Clumps = 1.57,
         .Size = 0.852, .SizeSpread = 0.23, .BlockSize = 0.126, .Stretch = 1.17, .Large = 0.0928, .LargeSize = 1.1,
         .Depth = 0.748, .Opaque = 0.359, .BlockOpaque = 0, .Most = 0.933, .Faint = 1.74, .BlockFaint = 0.24},
        {.Distance = 1.04, .Second = 0.853, .Third = 0.881, .Behind = 0.72, .Nowhere = 1.83, .Back = 2.47, .Fading = 0, .Clumps = 0.000354,
         .Size = 0.8, .SizeSpread = 0, .BlockSize = 0.321, .Stretch = 0.619, .Large = 0.186, .LargeSize = 1.08,
         .Depth = 0, .Opaque = 0.0907, .BlockOpaque = 0, .Most = 0.957, .Faint = 1.07, .BlockFaint = 0.0861},
        {.Distance = 0.684, .Second = 0.6, .Third = 0.723, .Behind = 0.78, .Nowhere = 1, .Back = 1.46, .Fading = 0.616, .Clumps = 0.989,
         .Size = 0.751, .SizeSpread = 0.227, .BlockSize = 0.29, .Stretch = 0.164, .Large = 0.137, .LargeSize = 1.81,
         .Depth = 0.207, .Opaque = 0.036, .BlockOpaque = 0, .Most = 0.716, .Faint = 0.668, .BlockFaint = 0.306},
    },
};
// clang-format on

} // namespace

const BenchmarkShape &benchmarkShape(BenchmarkKind K, int Gaussians) {
  // The halves of a factor of ten.
  const std::size_t Size = Gaussians < 31623 ? 0 : Gaussians < 316228 ? 1 : 2;
  return Shapes[static_cast<std::size_t>(K)][Size];
}

} // namespace vorion::splat::demo
