// Fitted to real scenes by least squares over the figures of
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
        {.Distance = 1.8, .Behind = 0.624, .Nowhere = 0.324, .Back = 1.52, .Fading = 0.115, .Clumps = 0.766,
         .Size = 1.9, .SizeSpread = 0.25, .BlockSize = 0.193, .Stretch = 0.4, .Large = 0.101, .LargeSize = 1.1,
         .Depth = 0.423, .Opaque = 0.00842, .Most = 0.26, .Faint = 4.64, .BlockFaint = 0.226},
        {.Distance = 1.8, .Behind = 9.43, .Nowhere = 1.27, .Back = 1.64, .Fading = 0.171, .Clumps = 1.19,
         .Size = 1.54, .SizeSpread = 0.385, .BlockSize = 0.141, .Stretch = 1.05, .Large = 0.0742, .LargeSize = 1.59,
         .Depth = 0.449, .Opaque = 0.257, .Most = 0.882, .Faint = 4.47, .BlockFaint = 0.169},
        {.Distance = 1.8, .Behind = 4.08, .Nowhere = 0.875, .Back = 1.96, .Fading = 0.119, .Clumps = 1.67,
         .Size = 1.66, .SizeSpread = 0.251, .BlockSize = 0.0995, .Stretch = 1.1, .Large = 0.0998, .LargeSize = 1.1,
         .Depth = 0.353, .Opaque = 0.256, .Most = 0.865, .Faint = 4.02, .BlockFaint = 0.157},
    },
    {
        {.Distance = 1.8, .Behind = 0, .Nowhere = 0.0845, .Back = 2.15, .Fading = 4, .Clumps = 0.576,
         .Size = 0.697, .SizeSpread = 0.168, .BlockSize = 0.316, .Stretch = 1.36, .Large = 0.186, .LargeSize = 1.1,
         .Depth = 0.418, .Opaque = 0.505, .Most = 0.953, .Faint = 0.25, .BlockFaint = 0.14},
        {.Distance = 1.49, .Behind = 0, .Nowhere = 0.107, .Back = 1.34, .Fading = 4.92, .Clumps = 0.698,
         .Size = 1.01, .SizeSpread = 0.391, .BlockSize = 0.143, .Stretch = 2, .Large = 0.0881, .LargeSize = 2.04,
         .Depth = 0.842, .Opaque = 0.41, .Most = 0.908, .Faint = 0.697, .BlockFaint = 0.154},
        {.Distance = 1.15, .Behind = 1.32, .Nowhere = 0.669, .Back = 2.49, .Fading = 3.29, .Clumps = 0.394,
         .Size = 0.332, .SizeSpread = 1.18, .BlockSize = 0.149, .Stretch = 1.86, .Large = 0.0512, .LargeSize = 1.86,
         .Depth = 0.585, .Opaque = 0.456, .Most = 0.917, .Faint = 1.14, .BlockFaint = 0.26},
    },
    {
        {.Distance = 0.932, .Behind = 0.252, .Nowhere = 0, .Back = 0.664, .Fading = 0.0502, .Clumps = 1.57,
         .Size = 0.852, .SizeSpread = 0.23, .BlockSize = 0.126, .Stretch = 1.17, .Large = 0.0928, .LargeSize = 1.1,
         .Depth = 0.748, .Opaque = 0.359, .Most = 0.933, .Faint = 1.74, .BlockFaint = 0.24},
        {.Distance = 1.01, .Behind = 1.18, .Nowhere = 1, .Back = 1.92, .Fading = 0.362, .Clumps = 0.165,
         .Size = 0.746, .SizeSpread = 0.13, .BlockSize = 0.237, .Stretch = 0.131, .Large = 0.134, .LargeSize = 1.1,
         .Depth = 0.205, .Opaque = 0.156, .Most = 0.898, .Faint = 1.36, .BlockFaint = 0.248},
        {.Distance = 0.684, .Behind = 2.14, .Nowhere = 1, .Back = 1.46, .Fading = 0.616, .Clumps = 0.256,
         .Size = 0.759, .SizeSpread = 0.227, .BlockSize = 0.29, .Stretch = 0.164, .Large = 0.137, .LargeSize = 1.81,
         .Depth = 0.207, .Opaque = 0.115, .Most = 0.913, .Faint = 1.85, .BlockFaint = 0.306},
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
