#include "translate/Translator.h"

#include "translate/HostCode.h"

#include <cassert>
#if VORION_TRANSLATOR
#include "translate/Emitter.h"
#endif

namespace vorion::isasim {

/// Of one program. Kernels with all their loops take some hundred thousand.
[[maybe_unused]] static constexpr size_t HostCodeBytes = 4 << 20;

Translator::~Translator() = default;

const char *Translator::needs() {
  return "an x86-64 host with AVX-512 F, BW, DQ, VL, CD and VPOPCNTDQ";
}

#if VORION_TRANSLATOR

/// One region's code at most.
static constexpr size_t RegionBytes = 1 << 19;

bool Translator::isThere() {
  return __builtin_cpu_supports("x86-64-v3") &&
         __builtin_cpu_supports("avx512f") &&
         __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512dq") &&
         __builtin_cpu_supports("avx512vl") &&
         __builtin_cpu_supports("avx512cd") &&
         __builtin_cpu_supports("avx512vpopcntdq");
}

Translator::Translator(CodeTable &Code, const ExecTable &Exec)
    : Code(Code), Exec(Exec),
      Host(std::make_unique<translate::HostCode>(HostCodeBytes)) {}

void Translator::seen(const Insn *At) {
  if (!Tried.insert(At).second)
    return;
  const std::vector<translate::GuestInsn> Region =
      translate::findRegion(Code, At);
  if (Region.empty())
    return;
  Buffer.resize(RegionBytes / sizeof(Line));
  const std::span<uint8_t> Bytes(Buffer.data()->Bytes, RegionBytes);
  try {
    translate::Emitter E(Exec, Code, Region, Bytes);
    E.write();
    E.ready();
    std::byte *Base = Host->add(Bytes.first(E.getSize()));
    if (!Base)
      return;
    ++Regions;
    for (const translate::Entry &In : E.entries()) {
      // The interpreter's handlers have this form, too.
      Code.setHandler(In.At, In.Full,
                      reinterpret_cast<Handler>(Base + In.Offset));
      Tried.insert(In.At);
    }
  } catch ([[maybe_unused]] const Xbyak::Error &Failed) {
    assert(static_cast<int>(Failed) == Xbyak::ERR_CODE_IS_TOO_BIG);
    // The interpreter goes on.
  }
}

#else

bool Translator::isThere() { return false; }

Translator::Translator(CodeTable &Code, const ExecTable &Exec)
    : Code(Code), Exec(Exec) {}

void Translator::seen(const Insn *) {}

#endif

} // namespace vorion::isasim
