#include "translate/Translator.h"

#include "translate/HostCode.h"

#include <algorithm>
#include <cassert>
#if VORION_TRANSLATOR
#include "translate/Emitter.h"
#endif

namespace vorion::isasim {

/// Of one program. Kernels with all their loops take some hundred thousand, and
/// with AVX2 three times as much.
[[maybe_unused]] static constexpr size_t HostCodeBytes = 10 << 20;

Translator::~Translator() = default;

const char *Translator::needs() {
  return "an x86-64 host with AVX2 and the rest of the level x86-64-v3";
}

size_t Translator::bytes() const { return Host ? Host->bytes() : 0; }

#if VORION_TRANSLATOR

/// One region's code at most: the longest (Region.cpp) take half of it with
/// AVX2.
static constexpr size_t RegionBytes = 3 << 20;

/// As the host's cache has them, so that constants lie as they will.
struct alignas(64) Line {
  uint8_t Bytes[64];
};

VectorUnit Translator::unitOfHost() {
  if (!__builtin_cpu_supports("x86-64-v3"))
    return VectorUnit::None;
  return __builtin_cpu_supports("avx512f") &&
                 __builtin_cpu_supports("avx512bw") &&
                 __builtin_cpu_supports("avx512dq") &&
                 __builtin_cpu_supports("avx512vl") &&
                 __builtin_cpu_supports("avx512cd") &&
                 __builtin_cpu_supports("avx512vpopcntdq")
             ? VectorUnit::Avx512
             : VectorUnit::Avx2;
}

Translator::Translator(CodeTable &Code, const ExecTable &Exec,
                       uint64_t CostOfInsn, VectorUnit Unit)
    : Code(Code), Exec(Exec), CostOfInsn(CostOfInsn), Unit(Unit),
      Host(std::make_unique<translate::HostCode>(HostCodeBytes)) {}

/// Whether one lane of several may be alone in a loop of \p Region.
static bool mayLeaveOneLane(const std::vector<translate::GuestInsn> &Region) {
  using translate::GuestInsn, translate::Kind;
  return std::ranges::any_of(
             Region, [](const GuestInsn &G) { return G.Is == Kind::Lanes; }) &&
         std::ranges::any_of(Region,
                             [](const GuestInsn &G) { return G.Loops != 0; });
}

void Translator::seen(const Insn *At, uint64_t Instructions,
                      const WarpState *Warp) {
  if (Done.contains(At))
    return;
  Credit += Instructions;
  if (Credit < Cost)
    return;
  std::vector<translate::GuestInsn> Region =
      translate::findRegion(Unit, Code, At);
  if (std::ranges::none_of(Region, [this](const translate::GuestInsn &G) {
        return G.Enters && !Done.contains(G.I);
      })) {
    Done.insert(At);
    return;
  }
  Cost = CostOfInsn * Region.size();
  if (Credit < Cost)
    return;
  // What one lane has says nothing of others that come back behind.
  if (Warp && Warp->LaneCount == 1 && Warp->WholeMask != Warp->Mask &&
      Alone++ != MostAlone)
    return;
  Alone = 0;
  Credit = Cost = 0;
  Done.insert(At);
  if (Warp)
    translate::guessAddresses(Region, *Warp);
  const auto Buffer =
      std::make_unique_for_overwrite<Line[]>(RegionBytes / sizeof(Line));
  const std::span<uint8_t> Bytes(Buffer[0].Bytes, RegionBytes);
  try {
    translate::OneLaneCode OneLane;
    if ((Warp && Warp->LaneCount == 1) || mayLeaveOneLane(Region))
      OneLane = translate::writeForOneLane(Exec, Code, Region, Bytes);
    const size_t Front =
        (OneLane.Bytes + sizeof(Line) - 1) / sizeof(Line) * sizeof(Line);
    translate::Emitter E(Unit, Exec, Code, Region, OneLane,
                         Bytes.subspan(Front));
    E.write();
    E.ready();
    std::byte *Base = Host->add(Bytes.first(Front + E.getSize()));
    if (!Base) {
      // Full, or the host allows no such memory: never again.
      Cost = UINT64_MAX;
      return;
    }
    ++Regions;
    Guesses += static_cast<unsigned>(
        std::ranges::count_if(Region, &translate::GuestInsn::HasOneAddress));
    for (const translate::Entry &In : E.entries()) {
      // The interpreter's handlers have this form, too.
      Code.setHandler(In.At, In.Full,
                      reinterpret_cast<Handler>(Base + Front + In.Offset));
      Done.insert(In.At);
    }
  } catch ([[maybe_unused]] const Xbyak::Error &Failed) {
    assert(static_cast<int>(Failed) == Xbyak::ERR_CODE_IS_TOO_BIG);
    // The interpreter goes on.
  }
}

#else

VectorUnit Translator::unitOfHost() { return VectorUnit::None; }

Translator::Translator(CodeTable &Code, const ExecTable &Exec,
                       uint64_t CostOfInsn, VectorUnit Unit)
    : Code(Code), Exec(Exec), CostOfInsn(CostOfInsn), Unit(Unit) {}

void Translator::seen(const Insn *, uint64_t, const WarpState *) {}

#endif

} // namespace vorion::isasim
