/// What a mesh cannot be drawn with (docs/meshes.md). Pictures without one keep
/// all rules.
#pragma once

#include "picture/Options.h"
#include "vorion/support/Expected.h"

#include <string>

namespace vorion::splat {

/// The camera of \p O must show straight lines straight. \p Cameras is its
/// file, for the message.
Expected<Success> checkMeshCamera(const RenderOptions &O,
                                  const std::string &Cameras);

/// Sub-pixel bits and formats of depths other than the default need a mesh,
/// filter bits its textures, and integer depths a camera whose depths fall with
/// 1/z. \p Cameras is the camera's file, for the message.
Expected<Success> checkMeshPrecision(const RenderOptions &O,
                                     const std::string &Cameras);

/// Transparent triangles must be drawn without depths beside the picture and
/// without overlap with the next one.
Expected<Success> checkTransparency(const RenderOptions &O, bool WantsDepths,
                                    bool Overlaps = false);

/// The error of normals, contributors and median depths beside a mesh.
Error layersBesideMesh();

/// Gradients need a mesh that is opaque.
Expected<Success> checkOpaque(const RenderOptions &O);

} // namespace vorion::splat
