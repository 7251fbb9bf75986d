/// Commands of the host, as the clock's command processor gets them
/// (docs/adr/0011-command-processor.md). They have no function: the host copies
/// memory itself, and the simulator executes launches one after the other.
#pragma once

#include <cstdint>
#include <vector>

namespace vorion::isasim {

/// What a command waits for: numbers of earlier commands, as Machine::copies()
/// and Machine::lastCommand() return them. 0 is no command.
struct CommandOrder {
  /// The command processor starts it behind these, as events say.
  std::vector<uint64_t> After;
  /// The host has waited for these before it sent the command, as for a copy
  /// from the device whose data it looks at.
  std::vector<uint64_t> HostAfter;
};

/// A copy for a DMA engine. A rectangle is a copy of as many bytes.
struct HostCopy {
  enum class Kind : uint8_t {
    ToDevice,
    FromDevice,
    OnDevice, ///< from one place of the device's memory to another
    Fill,     ///< of a pattern that the command has
  };
  Kind What = Kind::ToDevice;
  uint32_t Address = 0; ///< on the device; of OnDevice, the target
  uint32_t From = 0;    ///< of OnDevice
  uint64_t Bytes = 0;
};

} // namespace vorion::isasim
