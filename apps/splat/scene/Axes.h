/// Conversion of scenes between axis conventions. Readers do not convert; it is
/// done on request.
#pragma once

#include "scene/Scene.h"
#include "vorion/support/Expected.h"

#include <array>
#include <string>

namespace vorion::splat {

/// Signs of x, y and z: -1 for left, down and back, 1 for right, up and front.
using Axes = std::array<int, 3>;

/// Reads three letters for the directions of +x (r or l), +y (u or d) and +z (f
/// or b): "rdf" for the cameras of COLMAP and INRIA, "rub" for OpenGL and SPZ.
/// Error (Usage, with the name \p Option): any other text.
Expected<Axes> parseAxes(const std::string &Option, const std::string &Text);

/// Parses two conventions, "FROM:TO".
struct AxesChange {
  Axes From{1, 1, 1}, To{1, 1, 1};
};
Expected<AxesChange> parseAxesChange(const std::string &Option,
                                     const std::string &Text);

/// Expresses \p S, given in axes \p Change.From, in axes \p Change.To: means,
/// rotations and harmonics are mirrored exactly (signs change, nothing is
/// rounded). A change of one or three signs changes the handedness, and so
/// mirrors the scene. Cameras must be in \p Change.To already.
void changeAxes(Scene &S, const AxesChange &Change);

} // namespace vorion::splat
