/// A parsed and validated program for the machine: an ELF executable, or a raw
/// image of Vortex.
#pragma once

#include "vorion/support/Expected.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::isasim {

/// An argument of a kernel (vx_kernel_arg, docs/abi.md).
struct KernelArg {
  std::string Name;
  uint32_t Kind = 0;   ///< one of VX_ARG_*
  uint32_t Offset = 0; ///< within the packed arguments
  uint32_t Size = 0;
};

/// The program-scope variables that a kernel uses (vx_variables, docs/abi.md).
struct ProgramVariables {
  uint32_t Bytes = 0; ///< 0 for none
  uint32_t Alignment = 1;
  uint32_t Contents = 0, ContentsBytes = 0;
  uint32_t Pointers = 0, NumPointers = 0;
};

/// A kernel of the image (vx_kernel, docs/abi.md).
struct Kernel {
  std::string Name;
  uint32_t Entry = 0;
  std::vector<KernelArg> Args;
  uint32_t ArgsBytes = 0;
  uint32_t ContextBytes = 0;           ///< a work-item, kept across barriers
  uint32_t LocalBytes = 0;             ///< static local memory
  std::array<uint32_t, 3> LocalSize{}; ///< 0 for any
  uint32_t Lanes = 0;      ///< of the warps it was compiled for, 0 for any
  uint32_t StackBytes = 0; ///< that it needs of a lane's stack, 0 if not known
  /// Whether several warps of a core may run its work-groups.
  bool SharesCore = false;
  ProgramVariables Variables;

  /// Bytes that a group of \p Items work-items saves across barriers, rounded
  /// up to complete passes over the lanes.
  uint64_t contextBytesOf(uint64_t Items) const {
    const uint64_t Pass = std::max(Lanes, 1U);
    return (Items + Pass - 1) / Pass * Pass * ContextBytes;
  }
};

/// Immutable after parse(), so that it can be shared between threads.
class Image {
public:
  struct Segment {
    uint32_t Address = 0;
    uint32_t MemBytes = 0;        ///< what lies beyond Bytes is zero
    std::vector<std::byte> Bytes; ///< contents from the file
    bool Writable = false;
    bool Executable = false;
  };
  struct Symbol {
    uint32_t Address = 0;
    uint32_t Size = 0;
    bool IsFunction = false;
    bool IsAbsolute = false; ///< a number rather than a place in the image
    std::string Name;
  };

  /// Validates and parses \p Elf. \p Name is the file name for messages; a name
  /// with the extension .vxbin is a raw image (mem/VxBinReader.h). Errors:
  /// truncated or malformed file, not a 32-bit little-endian RISC-V executable,
  /// the ABI neither ilp32f nor ilp32, compressed code, a segment outside the
  /// image range, overlapping segments, writable code, an entry point outside
  /// the code, a malformed kernel table; names and arguments whose size is a
  /// multiple of the file's.
  static Expected<std::shared_ptr<const Image>>
  parse(std::span<const std::byte> Elf, std::string Name);

  /// An image of one segment that starts with its entry point.
  static std::shared_ptr<const Image> raw(Segment Only, std::string Name);

  const std::string &name() const { return Name; }
  /// The file, as it was given to parse().
  std::span<const std::byte> file() const { return File; }
  uint32_t entry() const { return Entry; }
  /// Stack size that main() needs per lane in bytes, 0 if unknown.
  uint32_t mainStackBytes() const { return MainStackBytes; }
  /// Entry point of a launch with several warps per core, 0 if there is none.
  uint32_t warpsEntry() const { return WarpsEntry; }
  const std::vector<Segment> &segments() const { return Segments; }
  const std::vector<Kernel> &kernels() const { return Kernels; }
  /// nullptr if there is no such kernel.
  const Kernel *findKernel(std::string_view KernelName) const;
  /// Error: a kernel, or the kernel \p Of, was compiled for warps with another
  /// number of lanes than \p Lanes, and would skip or repeat work-items.
  Expected<Success> checkLanes(uint32_t Lanes, std::string_view Of = {}) const;
  std::optional<uint32_t> findSymbol(std::string_view SymbolName) const;
  /// "function+0x1c" for the symbol that covers \p Address, or empty. An
  /// absolute symbol, usually a size, matches only its own value, and only if
  /// no other symbol covers it.
  std::string symbolize(uint32_t Address) const;
  /// Whether the load or store at \p Pc is an atomic access (section
  /// vorion_atomics, docs/abi.md).
  bool isAtomicPlace(uint32_t Pc) const {
    return std::ranges::binary_search(AtomicPlaces, Pc);
  }
  /// The initial bytes at [Address, Address + Bytes) if they are in one
  /// segment's file contents, else an empty span.
  std::span<const std::byte> bytesAt(uint32_t Address, uint32_t Bytes) const;

private:
  /// The segment that contains \p Address, or nullptr.
  const Segment *segmentAt(uint32_t Address) const;

  std::string Name;
  std::vector<std::byte> File;
  uint32_t Entry = 0, WarpsEntry = 0, MainStackBytes = 0;
  std::vector<Segment> Segments; ///< by address
  std::vector<Symbol> Symbols;   ///< by address
  std::vector<Kernel> Kernels;
  std::vector<uint32_t> AtomicPlaces; ///< sorted

  friend class ImageParser;
};

} // namespace vorion::isasim
