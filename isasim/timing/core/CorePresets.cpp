#include "vorion/isasim/Timing.h"

namespace vorion::isasim {

std::string_view name(CorePreset P) {
  constexpr std::string_view Names[] = {"forwarding", "vortex-5stage",
                                        "vortex-2025"};
  static_assert(std::size(Names) == size_t(CorePreset::Count));
  return Names[size_t(P)];
}

CoreTiming numbersOf(CorePreset P) {
  CoreTiming Numbers;
  switch (P) {
  case CorePreset::Forwarding:
  case CorePreset::Count:
    break;
#define PRESET(MEMBER, VORTEX_5STAGE, VORTEX_2025)                             \
  Numbers.MEMBER = VORTEX_5STAGE;
  case CorePreset::Vortex5Stage:
#include "vorion/isasim/CorePresets.def"
    break;
#define PRESET(MEMBER, VORTEX_5STAGE, VORTEX_2025) Numbers.MEMBER = VORTEX_2025;
  case CorePreset::Vortex2025:
#include "vorion/isasim/CorePresets.def"
    break;
  }
  return Numbers;
}

} // namespace vorion::isasim
