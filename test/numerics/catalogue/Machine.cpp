#include "Machine.h"

#include <cstdio>

namespace vorion::test {

Expected<Machine> Machine::open() {
  auto D = splat::Device::open("");
  if (!D)
    return D.error();
  return Machine(std::move(*D));
}

Expected<splat::RenderResult> Machine::render(const HardCase &C,
                                              const splat::RenderOptions &O,
                                              const std::string &KernelFolder) {
  splat::Launcher L(Dev, KernelFolder, {}, &Programs);
  auto R = splat::render(L, splat::planRender(C.Scene, O), C.Scene, C.View, O,
                         /*KeepPairs=*/false);
  if (!R && !L.buildLog().empty())
    std::fputs(L.buildLog().c_str(), stderr);
  return R;
}

} // namespace vorion::test
