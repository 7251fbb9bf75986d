/// Few values that stand for many: what formats with codebooks and palettes
/// write. The same input gives the same bits everywhere: nothing here is random
/// or runs on several threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vorion::splat {

/// 256 values, in ascending order, to which \p Values are near: k-means from
/// the quantiles. If there are at most 256 different ones, they are kept.
std::vector<double> codebookOf(std::vector<float> Values);

/// The place in \p Book, in ascending order, of the value nearest to \p Value.
uint8_t nearestIn(const std::vector<double> &Book, double Value);

/// Vectors that stand for those of a scene.
struct VectorPalette {
  std::vector<float> Entries;   ///< each as many numbers as a vector
  std::vector<uint32_t> Labels; ///< of each vector: its entry
};

/// At most \p Most entries for \p Vectors of \p Each numbers: groups are split
/// in two by 2-means, the one with the largest sum of squares first, until
/// there are so many or each holds one vector or equal ones.
VectorPalette paletteOf(const std::vector<float> &Vectors, std::size_t Each,
                        std::size_t Most);

} // namespace vorion::splat
