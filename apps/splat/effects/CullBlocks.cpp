// A block of 16 Gaussians of which the camera sees none is left out whole: its
// bounds say so, before any of its parameters is read. Same bits.

#include "effects/Registry.h"

namespace vorion::splat {

namespace {

Finding detect(const EffectInputs &In) {
  return In.Options.CullBlocks
             ? Finding{true, "--cull-blocks"}
             : Finding{false, "not requested (--cull-blocks)"};
}

} // namespace

const Effect effects::CullBlocks{
    .Name = "cull-blocks",
    .Kind = EffectKind::Machine,
    .What = "the kernel cull_blocks, and a test of its result in project",
    .Macro = "USE_CULL_BLOCKS",
    .Detect = detect,
    .ByCamera = true};

} // namespace vorion::splat
