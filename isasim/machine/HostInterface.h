/// The words `tohost` and `fromhost` of a program that has them: how test
/// programs for RISC-V end and print where there is a host to answer (HTIF, as
/// riscv-tests and Spike use it). docs/test-programs.md.
#pragma once

#include "core/HostBudget.h"
#include "mem/Memory.h"
#include "vorion/isasim/Image.h"

#include <functional>
#include <optional>
#include <string_view>

namespace vorion::isasim {

class HostInterface {
public:
  /// Keeps references to \p Storage and \p Budget. Print receives console
  /// text, in pieces.
  HostInterface(const Memory &Storage, const HostBudget &Budget,
                std::function<void(std::string_view)> Print)
      : Storage(Storage), Budget(Budget), Print(std::move(Print)) {}

  /// For a new run of \p Program; its words are looked for here.
  void reset(const Image &Program);

  /// Looks whether the program asks for something; called where all cores are
  /// parked. True if it does, which a program may wait for in a loop.
  bool poll();

  /// The code that the program ended with.
  const std::optional<uint32_t> &exitCode() const { return Exit; }

private:
  void execute(uint64_t Command);
  void callSystem(uint32_t Address);
  /// Prints at most \p Bytes bytes from \p Address on, up to the first that is
  /// not mapped; returns how many. Ends early where the run is over.
  uint64_t print(uint32_t Address, uint64_t Bytes);
  /// A 64-bit word, or 32 bits of one that lies at the end of memory.
  std::optional<uint64_t> read(uint32_t Address) const;
  void write(uint32_t Address, uint64_t Value);

  const Memory &Storage;
  const HostBudget &Budget;
  std::function<void(std::string_view)> Print;
  std::optional<uint32_t> ToHost, FromHost; ///< addresses
  uint64_t Seen = 0;                        ///< at the last poll
  std::optional<uint32_t> Exit;
};

} // namespace vorion::isasim
