/// The memory that a rasterizer sees (docs/abi.md, "Memory map").
#pragma once

#include <cstddef>
#include <cstdint>

namespace vorion::raster {

/// Global memory and nothing else: a core's local memory, its program image and
/// its stacks are faults for a rasterizer. Little-endian, as the host.
class RasterMemory {
public:
  virtual ~RasterMemory() = default;

  /// Host address of the \p Bytes bytes (at least 1) from \p Addr, contiguous
  /// and aligned as \p Addr up to 16 bytes, or nullptr if any of them is not
  /// global memory. Stays valid for the command that asked.
  virtual std::byte *range(uint32_t Addr, uint64_t Bytes) = 0;

  /// Whether nobody will look at what is being computed: lists are given up.
  virtual bool isOver() { return false; }
};

} // namespace vorion::raster
