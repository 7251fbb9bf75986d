/// The device's memory (docs/abi.md, "Memory map") in the host's address space.
#pragma once

#include "core/State.h"
#include "vorion/isasim/Config.h"
#include "vorion/isasim/Image.h"
#include "vorion/isasim/MemoryMap.h"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace vorion::isasim {

/// An anonymous mapping, zero and committed page by page when touched. Behind
/// its last page a vector access may read, not write; beyond that, and before
/// its first byte, any access ends the process: no guest can make one, and if
/// one ever could, it would not go on with the host's memory.
class Mapping {
public:
  static Expected<Mapping> make(uint64_t Bytes);
  Mapping(Mapping &&Other) noexcept;
  Mapping &operator=(Mapping &&Other) = delete;
  ~Mapping();
  std::byte *data() const { return Start; }

private:
  Mapping(std::byte *BaseIn, uint64_t AllIn, std::byte *StartIn)
      : Base(BaseIn), All(AllIn), Start(StartIn) {}
  std::byte *Base; ///< of all that is mapped
  uint64_t All;
  std::byte *Start;
};

/// How the memory of a run differs from the machine's.
struct RunMemory {
  uint32_t StackBytes; ///< of a lane, a power of two
  uint64_t Stacks;     ///< bytes of all of them, below VX_STACK_TOP
  /// What of global memory the program cannot write. Other ranges than whole
  /// multiples of LaunchAlignment, and more than two of them, are left out.
  std::vector<AddressRange> ReadOnly;
};

class Memory {
public:
  static Expected<std::unique_ptr<Memory>> create(const Config &C);

  /// Maps memory as \p Run needs it until endRun(). Stacks of another size than
  /// the machine's are zero, and cover the end of global memory, if that
  /// reaches so far. Errors: the host has no memory for them.
  Expected<Success> beginRun(const RunMemory &Run);
  void endRun();

  /// What core \p Core can reach. Valid until the next load(), beginRun() or
  /// endRun().
  MemoryView view(unsigned Core) const;

  /// Writes the image; the rest of the image range becomes zero.
  void load(const Image &Program);
  /// Local memory of all cores becomes zero.
  void clearLocal();
  /// What else stays from one run to the next: global memory and stacks of the
  /// machine's own size.
  std::vector<std::span<std::byte>> kept() const;

  /// [Address, Address + Bytes) in global memory, or nullptr.
  std::byte *global(uint32_t Address, uint64_t Bytes) const;
  /// The same for what the program reads and writes.
  std::byte *writable(uint32_t Address, uint64_t Bytes) const;
  /// The same in global memory or the image.
  std::byte *shared(uint32_t Address, uint64_t Bytes) const;
  /// The byte of a stack at \p Address, or nullptr. Stacks are not contiguous
  /// on the host.
  std::byte *stackByte(uint32_t Address) const;

private:
  explicit Memory(std::vector<Mapping> Maps);

  std::vector<Mapping> Mappings;
  Region Global, High, ImageRange; ///< as in MemoryView::Whole
  /// The machine's own stacks; those of the run, which may be LargeStacks.
  Region OwnStack, Stack;
  unsigned OwnStackShift = 0, StackShift = 0;
  uint64_t StackBytesOnHost = 0; ///< whole groups
  std::optional<Mapping> LargeStacks;
  std::vector<AddressRange> ReadOnly; ///< by address
  std::vector<Region> Locals;         ///< by core
  std::vector<Region> Writable;
};

} // namespace vorion::isasim
