#include "picture/Options.h"

namespace vorion::splat {

void drawAs(RenderOptions &O, const Drawing &D) {
  if (O.Kind != RendererKind::Splat) {
    O.Dilation = 0;
    return;
  }
  O.Antialiased = D.Antialiased;
  O.AntialiasedBy = D.Source;
  O.Dilation = static_cast<float>(D.Dilation.value_or(O.Dilation));
}

} // namespace vorion::splat
