#include "observe/check/Places.h"

#include "vorion/isasim/MemoryMap.h"
#include "vorion/support/Letters.h"

#include <algorithm>
#include <fmt/format.h>

namespace vorion::isasim {

void Places::begin(const RunStart &R) {
  Shape = R.Shape;
  Shape.StackBytes = R.StackBytes;
  Stacks = R.Stacks;
  Code = R.Program;
  HasLaunch = R.Launch != nullptr;
  Launch = HasLaunch ? *R.Launch : VxLaunch{};
}

Places::Kind Places::kindOf(uint32_t Address) const {
  if (Address >= VX_LOCAL_BASE)
    return Local;
  if (Address >= VX_STACK_TOP - Stacks)
    return Stack;
  if (Address - VX_IMAGE_BASE < VX_IMAGE_SIZE)
    return Program;
  for (const AddressRange &Part : globalRanges(Shape))
    if (Address - Part.Base < Part.Bytes)
      return Global;
  return Nothing;
}

bool Places::isOwn(uint32_t Address, unsigned Bytes, const Step &S,
                   unsigned Lane) const {
  switch (kindOf(Address)) {
  case Global:
    // Without a driver all of it is the program's.
    return Held.empty() || Held.find(Address, Bytes);
  case Local:
    return Address + uint64_t{Bytes} <= localEnd();
  case Stack:
    return !hasOwnStacks() || stackOf(Address) == stackOf(S, Lane);
  case Program:
    return std::any_of(
        Code->segments().begin(), Code->segments().end(),
        [&](const Image::Segment &Part) {
          const uint64_t Offset = uint64_t{Address} - Part.Address;
          return Address >= Part.Address && Offset + Bytes <= Part.MemBytes;
        });
  case Nothing:
    // The words of the console and of the exit code.
    return Address == VX_IO_CONSOLE || Address == VX_IO_EXIT;
  }
  return true;
}

std::string Places::describe(uint32_t Address, const Step &S,
                             unsigned Lane) const {
  switch (kindOf(Address)) {
  case Global:
    return Held.empty() ? "in global memory" : Held.describe(Address);
  case Local:
    return fmt::format("{} into local memory, of which the group has {}",
                       counted(Address - VX_LOCAL_BASE, "byte"),
                       localEnd() - VX_LOCAL_BASE);
  case Stack: {
    const uint32_t Number = stackOf(Address);
    if (hasOwnStacks() && Number == stackOf(S, Lane))
      return fmt::format(
          "{} below the top of its stack",
          counted(VX_STACK_TOP - Number * Shape.StackBytes - Address, "byte"));
    const unsigned Warp = Number / Shape.LanesPerWarp;
    return fmt::format("in the stack of core {}, {}lane {}", Warp / warps(),
                       warps() == 1 ? ""
                                    : fmt::format("warp {}, ", Warp % warps()),
                       Number % Shape.LanesPerWarp);
  }
  case Program: {
    const std::string Symbol = Code->symbolize(Address);
    return Symbol.empty() ? "in the program's range, outside its sections"
                          : "at " + Symbol;
  }
  case Nothing:
    break;
  }
  return Address < globalBase(Shape) ? "near address 0: a null pointer?"
                                     : "unmapped memory";
}

std::string Places::describeAccess(const Step &S, unsigned Lane) const {
  constexpr const char *Kinds[] = {"load", "store", "atomic"};
  const uint32_t Address = S.Access->Addresses[Lane];
  return fmt::format("{} of {} byte{} at 0x{:08x}, {}", Kinds[S.Access->What],
                     S.Access->Bytes, S.Access->Bytes == 1 ? "" : "s", Address,
                     describe(Address, S, Lane));
}

} // namespace vorion::isasim
