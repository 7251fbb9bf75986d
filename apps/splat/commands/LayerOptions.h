/// The options of additional outputs of a picture (docs/judging.md).
#pragma once

#include "render/Layers.h"

#include <CLI/CLI.hpp>

namespace vorion::splat {

/// Declares them; \p F must outlive the parsing.
void addLayerOptions(CLI::App &App, LayerFiles &F);

/// Checks that file extensions and options are consistent; otherwise a usage
/// error. \p IsOne: one picture is rendered.
Expected<Success> checkLayers(const LayerFiles &F, const RenderOptions &O,
                              bool IsOne);

} // namespace vorion::splat
