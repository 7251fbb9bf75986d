#include "core/LaneMemory.h"

#include "core/Core.h"
#include "core/Lanes.h"
#include "core/Reach.h"

#include <cstring>

namespace vorion::isasim {

namespace {

/// Where Vortex's own programs store console bytes, a lane each (its
/// IO_COUT_ADDR and IO_COUT_SIZE).
constexpr uint32_t ConsoleBytes = 64;

bool storeIo(WarpState *S, unsigned Bytes, uint32_t Addr, uint32_t Value) {
  if (Bytes == 1 && Addr - VX_IO_CONSOLE < ConsoleBytes) {
    S->Owner->print(static_cast<char>(Value));
    return true;
  }
  if (Bytes != 4)
    return false;
  if (Addr == VX_IO_CONSOLE)
    S->Owner->print(static_cast<char>(Value));
  else if (Addr == VX_IO_EXIT)
    S->Owner->exitWith(Value);
  else
    return false;
  return true;
}

} // namespace

bool loadByLane(WarpState *S, const Insn *I, unsigned Bytes, bool Signed) {
  uint32_t Values[MaxLanes] = {};
  const uint32_t *Base = S->lanes(I->Rs1);
  const bool Ok = forLanes(S, [&](unsigned L) {
    const uint32_t Addr = Base[L] + static_cast<uint32_t>(I->Imm);
    if (Addr % Bytes != 0)
      return fault(S, TrapCause::MisalignedLoad, L, Addr);
    if (isStray(S, L, Addr))
      return fault(S, TrapCause::StackOverflow, L, Addr);
    const std::byte *From = readableAt(*S->Mem, Addr, Bytes);
    if (!From)
      return fault(S, TrapCause::LoadFault, L, Addr);
    std::memcpy(&Values[L], From, Bytes);
    const unsigned Shift = 32 - 8 * Bytes;
    if (Signed)
      Values[L] = static_cast<uint32_t>(
          static_cast<int32_t>(Values[L] << Shift) >> Shift);
    return true;
  });
  if (Ok)
    writeLanes(S, I->Rd, Values);
  return Ok;
}

bool storeByLane(WarpState *S, const Insn *I, unsigned Bytes) {
  const uint32_t *Base = S->lanes(I->Rs1);
  const uint32_t *Values = S->lanes(I->Rs2);
  return forLanes(S, [&](unsigned L) {
    const uint32_t Addr = Base[L] + static_cast<uint32_t>(I->Imm);
    if (Addr % Bytes != 0)
      return fault(S, TrapCause::MisalignedStore, L, Addr);
    if (isStray(S, L, Addr))
      return fault(S, TrapCause::StackOverflow, L, Addr);
    if (std::byte *To = writableAt(*S->Mem, Addr, Bytes)) {
      std::memcpy(To, &Values[L], Bytes);
      return true;
    }
    return storeIo(S, Bytes, Addr, Values[L]) ||
           fault(S, TrapCause::StoreFault, L, Addr);
  });
}

} // namespace vorion::isasim
