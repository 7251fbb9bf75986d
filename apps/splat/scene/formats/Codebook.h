/// Vector quantization for formats with codebooks and palettes. Deterministic
/// on all hosts: no randomness and no threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vorion::splat {

/// A codebook of 256 values in ascending order for \p Values: k-means,
/// initialized with quantiles. At most 256 distinct values are preserved.
std::vector<double> codebookOf(std::vector<float> Values);

/// The index in \p Book, in ascending order, of the value nearest to \p Value.
uint8_t nearestIn(const std::vector<double> &Book, double Value);

/// A palette of vectors, and the index of each vector of a scene.
struct VectorPalette {
  std::vector<float> Entries;   ///< each as many numbers as a vector
  std::vector<uint32_t> Labels; ///< of each vector: its entry
};

/// A palette of at most \p Most entries for \p Vectors of \p Each numbers, by
/// bisecting 2-means: the cluster with the largest sum of squared errors is
/// split first, until the number is reached or all clusters have equal vectors.
VectorPalette paletteOf(const std::vector<float> &Vectors, std::size_t Each,
                        std::size_t Most);

} // namespace vorion::splat
