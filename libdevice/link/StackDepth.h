/// How much of a lane's stack the kernels of a program need. The linker is the
/// first that knows all functions that a kernel calls.
#pragma once

#include "vorion/support/Expected.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace vorion::link {

/// What a kernel, or main, needs.
struct StackNeed {
  std::string Name;
  /// Of its deepest path of calls. Functions that call each other in a circle
  /// count once each, and VX_REPEAT_BYTES count where there is such a circle, a
  /// call through a pointer, a frame of a size that the run decides, or a
  /// function that no compiler of ours has seen.
  uint64_t Bytes;
};

/// Writes what the kernels of \p Program, an executable, need into its kernel
/// table, and what main needs as the size of its PT_GNU_STACK (docs/abi.md),
/// and returns all of them. A kernel of no function in the section
/// vorion_stacks keeps its number, and is not returned. Nothing happens to what
/// is no 32-bit ELF file. Errors: malformed sections. \p Name is used in
/// messages only.
Expected<std::vector<StackNeed>> writeStackNeeds(std::span<std::byte> Program,
                                                 const std::string &Name);

} // namespace vorion::link
