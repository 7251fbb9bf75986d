/// Scenes for tests, and writers of what only tests write: they quantise by the
/// formulas that the format documents, and are written apart from the readers.
#pragma once

#include "io/Gzip.h"
#include "scene/Scene.h"
#include "scene/formats/Writers.h"

#include <map>
#include <string>

namespace vorion::splat::testing {

/// \p Count Gaussians with unit quaternions, means within 50 of the origin,
/// scales from e^-8 to 1, opacities from 0.007 to 0.993 and coefficients
/// within 0.9; the same on every host.
Scene randomScene(std::size_t Count, int ShDegree, unsigned Seed);

/// \p Count Gaussians with a different value in every field.
Scene numberedScene(std::size_t Count, int ShDegree);

/// Files by name: a folder, or what goes into a zip archive.
using Folder = std::map<std::string, std::string>;

/// A `.ksplat` of two sections in compression 0, 1 or 2, whose buckets of eight
/// Gaussians are the scene's in order.
std::string ksplatOf(const Scene &S, int Compression);
/// An `.spz` of version 4, with \p Extensions between header and table.
std::string spz4Of(const Scene &S, const std::string &Extensions = "");
/// A glTF file in parts: its text, where its one buffer has the name \p Uri or
/// is a GLB's if that is empty, and the buffer. Attributes are floats, each in
/// a view of its own; \p S is in a node with the members \p Node.
struct GltfParts {
  std::string Text, Buffer;
};
GltfParts gltfOf(const Scene &S, const std::string &Uri = "",
                 const std::string &Node = "");
/// A `.glb` of such parts.
std::string glbOf(const GltfParts &P);
/// The parts of a `.glb` whose one primitive holds the file \p Spz.
GltfParts gltfOfSpz(const std::string &Spz);
/// The codebooks are 256 even steps over what the scene has; the palette has
/// an entry for each Gaussian. \p Version is 1 or 2.
Folder sogOf(const Scene &S, int Version = 2);
std::string zipOf(const Folder &Files);

/// A lossless WebP of \p Rgba, 4 bytes a pixel.
std::string webpOf(int Width, int Height, const std::string &Rgba);

} // namespace vorion::splat::testing
