/// The launch of a kernel in a machine's global memory: what it needs there,
/// how it is written, and what it printed (docs/abi.md, "Launch block and
/// kernel table"). Whoever starts kernels allocates; this is the only code that
/// knows the block.
#pragma once

#include "vorion/isasim/Config.h"
#include "vorion/isasim/Image.h"
#include "vorion/support/Expected.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace vorion::isasim {

class Machine;
class Session;

/// Of buffers, of local arguments, and of each core's share of what is kept
/// across barriers, in bytes.
inline constexpr uint64_t LaunchAlignment = 128;
/// Work-items of a group (docs/decisions.md, 6).
inline constexpr uint32_t MaxGroupItems = 1024;
/// Groups of a launch: the start-up code's group number plus the number of
/// cores must not wrap.
inline constexpr uint64_t MaxGroups = uint64_t{1} << 31;
/// Bytes of a launch's print buffer: OpenCL's least
/// CL_DEVICE_PRINTF_BUFFER_SIZE of the full profile. A few of them say how many
/// others are in use.
inline constexpr uint32_t PrintBytes = 1 << 20;

/// \p Bytes, rounded up to LaunchAlignment.
constexpr uint64_t alignLaunch(uint64_t Bytes) {
  return (Bytes + LaunchAlignment - 1) / LaunchAlignment * LaunchAlignment;
}

/// The range that a launch is a part of, in each dimension.
struct WholeRange {
  std::array<uint32_t, 3> EnqueuedSize{1, 1, 1}; ///< of all groups but the last
  std::array<uint32_t, 3> GroupsBefore{};        ///< the launch's first
  std::array<uint32_t, 3> AllGroups{1, 1, 1};
  std::array<uint32_t, 3> GlobalSize{1, 1, 1};
};

/// Groups and work-items of a launch; 1 in dimensions that are not used.
struct LaunchShape {
  uint32_t WorkDim = 1;                       ///< 1 to 3
  std::array<uint32_t, 3> NumGroups{1, 1, 1}; ///< 0 runs nothing
  std::array<uint32_t, 3> LocalSize{1, 1, 1};
  std::array<uint32_t, 3> GlobalOffset{};
  /// Local memory of a group: the kernel's own and its arguments'. Absent if
  /// nothing says how much the arguments have.
  std::optional<uint64_t> LocalBytes = std::nullopt;
  /// Absent for a launch of a whole range.
  std::optional<WholeRange> PartOf = std::nullopt;
};

/// Something for each part of a launch: its bytes, or its address. 0 where the
/// launch does without.
struct LaunchParts {
  uint64_t Block = 0, Args = 0, Context = 0, Print = 0;
  /// Variables of program scope, which outlive the launch.
  uint64_t Variables = 0;
};

class Launch {
public:
  /// Errors: a shape that \p K or any launch cannot have (Usage); local memory,
  /// stacks, or memory that is kept across barriers, that a machine of \p C has
  /// not (LimitReached).
  static Expected<Launch> plan(const Kernel &K, const LaunchShape &S,
                               const Config &C);

  /// The bytes of each part.
  const LaunchParts &bytes() const { return Bytes; }

  /// The bytes at the end of global memory that the stacks cover, and that
  /// nothing else may lie in while the launch runs.
  uint64_t bytesUnderStacks() const { return BytesUnderStacks; }
  /// Where the stacks begin.
  uint64_t stacksBegin() const { return StacksBegin; }

  /// Writes block and arguments to where \p Addresses says, and tells \p Watch.
  void write(Machine &M, Session &Watch, const LaunchParts &Addresses,
             std::span<const std::byte> Args) const;

private:
  Launch(const Kernel &K, const LaunchShape &S) : Entry(K.Entry), Shape(S) {}
  uint32_t Entry;
  LaunchShape Shape;
  LaunchParts Bytes;
  uint32_t Cores = 1;
  uint32_t ContextStride = 0, LocalStride = 0;
  uint32_t Warps = 1; ///< of a core
  uint32_t StackBytes = 0;
  uint64_t StacksBegin = 0, BytesUnderStacks = 0;
};

/// The bytes to allocate for \p V, with room to align them.
uint64_t bytesFor(const ProgramVariables &V);
/// Where \p V lies in what was allocated at \p Address, aligned as any launch's
/// parts.
uint32_t placeOf(const ProgramVariables &V, uint32_t Address);
/// Gives the variables that \p K of \p Program uses their initial values, where
/// placeOf() says, and tells \p Watch.
void writeVariables(Machine &M, Session &Watch, const Image &Program,
                    const Kernel &K, uint32_t Place);

/// What a launch left of its printf.
struct Printed {
  std::string Text;     ///< complete lines or not
  uint64_t Dropped = 0; ///< bytes that did not fit
};
/// Of the launch at \p Addresses, after its run.
Printed printedBy(Machine &M, const LaunchParts &Addresses);

/// Places local-memory arguments behind a kernel's own local memory.
class LocalPlaces {
public:
  LocalPlaces(const Kernel &K, const Config &C)
      : Name(K.Name), Capacity(C.LocalBytes), End(K.LocalBytes) {}

  /// The address of \p Bytes more. Error (LimitReached): there is no room.
  Expected<uint32_t> place(uint64_t Bytes);
  /// Local memory that is in use.
  uint64_t used() const { return End; }

private:
  std::string Name;
  uint64_t Capacity, End;
};

} // namespace vorion::isasim
