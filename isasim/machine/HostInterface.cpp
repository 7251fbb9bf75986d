#include "machine/HostInterface.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace vorion::isasim {

namespace {

// A command: device in the top byte, command below it, then the payload.
constexpr unsigned DeviceShift = 56, CommandShift = 48;
constexpr uint64_t PayloadMask = (uint64_t{1} << CommandShift) - 1;
constexpr uint64_t SystemDevice = 0, ConsoleDevice = 1;
constexpr uint64_t ConsoleWrite = 1;

// Calls that programs make by an array of four words in memory.
constexpr uint64_t CallWrite = 64, CallExit = 93;
constexpr uint64_t NoSuchCall = ~uint64_t{37}; // -ENOSYS

} // namespace

void HostInterface::reset(const Image &Program) {
  ToHost = Program.findSymbol("tohost");
  FromHost = Program.findSymbol("fromhost");
  Seen = 0;
  Exit.reset();
}

std::optional<uint64_t> HostInterface::read(uint32_t Address) const {
  uint64_t Value = 0;
  const std::byte *At = Storage.shared(Address, sizeof(Value));
  if (!At)
    return std::nullopt;
  std::memcpy(&Value, At, sizeof(Value));
  return Value;
}

void HostInterface::write(uint32_t Address, uint64_t Value) {
  if (std::byte *At = Storage.shared(Address, sizeof(Value)))
    std::memcpy(At, &Value, sizeof(Value));
}

bool HostInterface::poll() {
  if (!ToHost || Exit)
    return false;
  const uint64_t Command = read(*ToHost).value_or(0);
  // A core of 32 bits stores one half after the other, and may have been parked
  // between: what stands there for the second time is complete.
  const bool Complete = Command != 0 && Command == Seen;
  Seen = Complete ? 0 : Command;
  if (Complete) {
    write(*ToHost, 0);
    execute(Command);
  }
  return Command != 0;
}

void HostInterface::execute(uint64_t Command) {
  const uint64_t Device = Command >> DeviceShift;
  const uint64_t Payload = Command & PayloadMask;
  if (Device == ConsoleDevice &&
      (Command >> CommandShift & 0xFF) == ConsoleWrite)
    Print(std::string_view(std::array{static_cast<char>(Payload)}.data(), 1));
  else if (Device == SystemDevice && (Payload & 1))
    Exit = static_cast<uint32_t>(Payload >> 1);
  else if (Device == SystemDevice)
    callSystem(static_cast<uint32_t>(Payload));
}

uint64_t HostInterface::print(uint32_t Address, uint64_t Bytes) {
  uint64_t Printed = 0;
  while (Printed != Bytes && !Budget.mustStop()) {
    const auto From = static_cast<uint32_t>(Address + Printed);
    uint64_t Piece =
        std::min<uint64_t>(Bytes - Printed, HostBudget::ConsoleBytes);
    // The last that is mapped is found by halves.
    while (Piece != 0 && !Storage.shared(From, Piece))
      Piece /= 2;
    if (Piece == 0)
      break;
    Print({reinterpret_cast<const char *>(Storage.shared(From, Piece)), Piece});
    Printed += Piece;
  }
  return Printed;
}

void HostInterface::callSystem(uint32_t Address) {
  std::array<uint64_t, 4> Call{}; // number, then arguments
  for (uint32_t N = 0; N != Call.size(); ++N)
    Call[N] = read(Address + 8 * N).value_or(0);
  uint64_t Result = NoSuchCall;
  if (Call[0] == CallWrite) {
    Result = print(static_cast<uint32_t>(Call[2]), Call[3]);
  } else if (Call[0] == CallExit) {
    Exit = static_cast<uint32_t>(Call[1]);
  }
  write(Address, Result);
  if (FromHost)
    write(*FromHost, 1);
}

} // namespace vorion::isasim
