/// The options of outputs beside a picture (docs/judging.md).
#pragma once

#include "render/Layers.h"

#include <CLI/CLI.hpp>

namespace vorion::splat {

/// Declares them; \p F must outlive the parsing.
void addLayerOptions(CLI::App &App, LayerFiles &F);

/// Whether endings and options go together; an error is one of usage.
/// \p IsOne: one picture is drawn.
Expected<Success> checkLayers(const LayerFiles &F, const RenderOptions &O,
                              bool IsOne);

} // namespace vorion::splat
