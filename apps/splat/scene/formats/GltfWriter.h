/// Writing of `.glb` files: Gaussians with KHR_gaussian_splatting, and what
/// others add to them.
#pragma once

#include "scene/Scene.h"
#include "vorion/support/Expected.h"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

namespace vorion::splat {

/// A glTF file in memory, part by part. The functions that add return the
/// index of what was added.
class GltfWriter {
public:
  using Json = nlohmann::ordered_json;

  GltfWriter();

  /// A bufferView of its own.
  std::size_t addView(std::span<const std::byte> Content);
  /// \p Numbers, \p Width for each element; \p HasBounds: with their least and
  /// largest, as POSITION must have.
  std::size_t addAccessor(std::span<const float> Numbers, std::size_t Width,
                          bool HasBounds = false);
  std::size_t addIndices(std::span<const uint32_t> Numbers);
  /// An object of the list \p Key.
  std::size_t add(const char *Key, Json Object);
  void useExtension(std::string_view Name, bool IsRequired = false);
  /// A node of the scene with a mesh of \p Primitives; \p Name may be empty.
  void addNode(Json Primitives, const std::string &Name = "");
  void addGaussians(const Scene &S);

  /// The file. Error: more than the 4 GiB of a `.glb`.
  Expected<std::string> finish() const;

private:
  std::size_t addNumbers(std::span<const std::byte> Content, int Component,
                         const char *Type, std::size_t Count);

  Json Document;
  std::string Buffer;
};

} // namespace vorion::splat
