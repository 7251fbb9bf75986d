/// The device's memory (docs/abi.md, "Memory map") in the host's address space.
#pragma once

#include "core/State.h"
#include "vorion/isasim/Config.h"
#include "vorion/isasim/Image.h"

#include <memory>
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

class Memory {
public:
  static Expected<std::unique_ptr<Memory>> create(const Config &C);

  /// What core \p Core can reach. Valid until the next load().
  MemoryView view(unsigned Core) const;

  /// Writes the image; the rest of the image range becomes zero.
  void load(const Image &Program);
  /// Local memory of all cores becomes zero.
  void clearLocal();
  /// What else stays from one run to the next: global memory and the stacks.
  std::vector<std::span<std::byte>> kept() const;

  /// [Address, Address + Bytes) in global memory, or nullptr.
  std::byte *global(uint32_t Address, uint64_t Bytes) const;
  /// The same in global memory or the image.
  std::byte *shared(uint32_t Address, uint64_t Bytes) const;
  /// The byte of a stack at \p Address, or nullptr. Stacks are not contiguous
  /// on the host.
  std::byte *stackByte(uint32_t Address) const;

private:
  explicit Memory(std::vector<Mapping> Maps);

  std::vector<Mapping> Mappings;
  Region Global, High, Stack, ImageRange; ///< as in MemoryView
  unsigned StackShift = 0;
  uint64_t StackBytesOnHost = 0; ///< whole groups
  std::vector<Region> Locals;    ///< by core
  std::vector<Region> Writable;
};

} // namespace vorion::isasim
