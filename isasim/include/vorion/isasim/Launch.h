/// The launch of a kernel: its requirements of global memory, the encoding of
/// its launch block, and its print buffer (docs/abi.md, "Launch block and
/// kernel table"). The caller allocates memory; no other code depends on the
/// layout of the block.
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

/// Alignment in bytes of buffers, of local arguments, and of each core's part
/// of the memory for values saved across barriers.
inline constexpr uint64_t LaunchAlignment = 128;
/// Maximum work-group size (docs/decisions.md, 6).
inline constexpr uint32_t MaxGroupItems = 1024;
/// Maximum number of work-groups of a launch: the start-up code's group ID plus
/// the number of cores must not wrap.
inline constexpr uint64_t MaxGroups = uint64_t{1} << 31;
/// Size in bytes of a launch's print buffer: the minimum
/// CL_DEVICE_PRINTF_BUFFER_SIZE of OpenCL's full profile, including the header
/// with the number of used bytes.
inline constexpr uint32_t PrintBytes = 1 << 20;

/// \p Bytes, rounded up to LaunchAlignment.
constexpr uint64_t alignLaunch(uint64_t Bytes) {
  return (Bytes + LaunchAlignment - 1) / LaunchAlignment * LaunchAlignment;
}

/// The enqueued range of which a launch is a part, in each dimension.
struct WholeRange {
  std::array<uint32_t, 3> EnqueuedSize{1, 1, 1}; ///< of all groups but the last
  std::array<uint32_t, 3> GroupsBefore{};        ///< the launch's first
  std::array<uint32_t, 3> AllGroups{1, 1, 1};
  std::array<uint32_t, 3> GlobalSize{1, 1, 1};
};

/// Number of work-groups and work-group size of a launch; 1 in unused
/// dimensions.
struct LaunchShape {
  uint32_t WorkDim = 1;                       ///< 1 to 3
  std::array<uint32_t, 3> NumGroups{1, 1, 1}; ///< 0 runs nothing
  std::array<uint32_t, 3> LocalSize{1, 1, 1};
  std::array<uint32_t, 3> GlobalOffset{};
  /// Local memory of a group in bytes: static and of arguments. Empty if the
  /// size of arguments is unknown.
  std::optional<uint64_t> LocalBytes = std::nullopt;
  /// Empty for the launch of a complete range.
  std::optional<WholeRange> PartOf = std::nullopt;
};

/// A value for each part of a launch: its size or its address. 0 if the launch
/// does not use it.
struct LaunchParts {
  uint64_t Block = 0, Args = 0, Context = 0, Print = 0;
  /// Program-scope variables, which outlive the launch.
  uint64_t Variables = 0;
};

class Launch {
public:
  /// Errors: a shape that is invalid for \p K or any launch (Usage); more local
  /// memory, stack, or memory for values saved across barriers than a machine
  /// with \p C has (LimitReached).
  static Expected<Launch> plan(const Kernel &K, const LaunchShape &S,
                               const Config &C);

  /// The size of each part in bytes.
  const LaunchParts &bytes() const { return Bytes; }

  /// Bytes at the end of global memory that the stacks cover, which must not be
  /// used otherwise during the launch.
  uint64_t bytesUnderStacks() const { return BytesUnderStacks; }
  /// Lowest address of the stacks.
  uint64_t stacksBegin() const { return StacksBegin; }

  /// Writes block and arguments to \p Addresses, and notifies \p Watch.
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

/// Bytes to allocate for \p V, including padding for alignment.
uint64_t bytesFor(const ProgramVariables &V);
/// The aligned address of \p V in the allocation at \p Address.
uint32_t placeOf(const ProgramVariables &V, uint32_t Address);
/// Initializes the program-scope variables of \p K of \p Program at placeOf(),
/// and notifies \p Watch.
void writeVariables(Machine &M, Session &Watch, const Image &Program,
                    const Kernel &K, uint32_t Place);

/// The printf output of a launch.
struct Printed {
  std::string Text;     ///< complete lines or not
  uint64_t Dropped = 0; ///< bytes that did not fit
};
/// The output of the launch at \p Addresses, after its run.
Printed printedBy(Machine &M, const LaunchParts &Addresses);

/// Allocates local-memory arguments after a kernel's static local memory.
class LocalPlaces {
public:
  LocalPlaces(const Kernel &K, const Config &C)
      : Name(K.Name), Capacity(C.LocalBytes), End(K.LocalBytes) {}

  /// Allocates \p Bytes and returns their address. Error (LimitReached): out of
  /// local memory.
  Expected<uint32_t> place(uint64_t Bytes);
  /// Allocated local memory in bytes.
  uint64_t used() const { return End; }

private:
  std::string Name;
  uint64_t Capacity, End;
};

} // namespace vorion::isasim
