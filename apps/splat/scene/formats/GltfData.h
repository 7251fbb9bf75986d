/// The containers of a glTF file: JSON, buffers, accessors, nodes.
#pragma once

#include "scene/formats/Gltf.h"

#include <array>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

namespace vorion::splat {

/// The elements of a glTF accessor by component, as doubles: normalized ones
/// from -1 or 0 to 1.
struct GltfAccessor {
  Bytes View;             ///< of the first element on
  std::size_t Count = 0;  ///< elements
  std::size_t Width = 0;  ///< numbers of an element
  std::size_t Stride = 0; ///< bytes from an element to the next
  int Component = 0;      ///< glTF's number of the type
  bool Normalised = false;

  double at(std::size_t Element, std::size_t Number) const;
};

/// Column-major as in glTF: a point is transformed to M p.
using GltfMatrix = std::array<double, 16>;
GltfMatrix product(const GltfMatrix &A, const GltfMatrix &B);

/// A node with a mesh, and its world transform.
struct GltfInstance {
  std::size_t Mesh = 0;
  std::string Name; ///< of the node; may be empty
  GltfMatrix Transform{};
};

/// A glTF file whose containers were looked at; what is in them is checked when
/// it is asked for. Every Error is one line that names the file and the part.
class GltfData {
public:
  /// \p File must live as long as the result.
  static Expected<GltfData> open(const std::string &Where, Bytes File,
                                 const GltfSource &Read);

  const nlohmann::json &document() const { return Document; }
  /// The object number \p Index of the list \p Key.
  Expected<const nlohmann::json *> objectAt(const char *Key,
                                            std::size_t Index) const;
  Expected<Bytes> bufferView(std::size_t Index) const;
  /// The file of image \p Index: a bufferView, data of a URI, or what
  /// \p Read has.
  Expected<std::vector<std::byte>> image(std::size_t Index,
                                         const GltfSource &Read) const;
  /// Total size of all buffers in bytes, an upper bound of elements of \c
  /// accessor.
  std::size_t bytes() const;
  Expected<GltfAccessor> accessor(std::size_t Index) const;
  /// Of the default scene, or of all nodes if there is no scene.
  Expected<std::vector<GltfInstance>> instances() const;

private:
  Error wrong(std::string What) const { return {Where, std::move(What)}; }
  Expected<std::vector<std::byte>> content(const std::string &Uri,
                                           const std::string &Owner,
                                           const GltfSource &Read) const;
  Expected<Success> readBuffers(Bytes Binary, bool HasBinary,
                                const GltfSource &Read);
  Expected<Success> walk(std::size_t Node, const GltfMatrix &Parent,
                         std::set<std::size_t> &Seen,
                         std::vector<GltfInstance> &To) const;

  std::string Where;
  nlohmann::json Document;
  std::vector<std::vector<std::byte>> Owned; ///< of buffers that are not in
                                             ///< the file as they are
  std::vector<Bytes> Buffers;
};

/// The integer \p Key of \p Object, \p Otherwise if it is missing. Empty if it
/// is not an integer from 0 to 2^53.
std::optional<std::size_t> gltfIndex(const nlohmann::json &Object,
                                     const char *Key,
                                     std::optional<std::size_t> Otherwise);

} // namespace vorion::splat
