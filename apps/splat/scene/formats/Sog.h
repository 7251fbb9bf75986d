/// PlayCanvas's SOG, versions 1 and 2: parameters as planes of WebP pictures.
/// https://developer.playcanvas.com/user-manual/gaussian-splatting/formats/sog
#pragma once

#include "scene/SceneFile.h"

#include <functional>
#include <memory>
#include <vector>

namespace vorion::splat {

/// Reads a file of a data set by its name. Error: more than \p Most bytes.
using FileSource = std::function<Expected<std::vector<std::byte>>(
    const std::string &Name, std::size_t Most)>;

/// A data set with its description and decoded pictures, whose Gaussians are
/// then written to a scene of one or more data sets. It has positions of 16
/// bits between bounds of sign(x) ln(|x| + 1); log scales, colours and
/// harmonics by codebooks of 256 numbers, harmonics in a palette of up to
/// 65,536 entries; rotations of 8 bits for each of the three smallest
/// components; opacity of 8 bits. Version 1 has even steps between bounds where
/// version 2 has codebooks, and logits of opacities.
class SogData {
public:
  /// \p Meta is the content of meta.json, and \p Read is used until this
  /// returns. \p Where names the data set in messages, \p MetaWhere its
  /// description. Refused: damaged pictures, planes smaller than the count, of
  /// different sizes, or out of proportion to their files or to the count,
  /// models other than default and antialiased.
  static Expected<SogData> open(const std::string &Where,
                                const std::string &MetaWhere, Bytes Meta,
                                const FileSource &Read);
  SogData(SogData &&) noexcept;
  ~SogData();

  /// Its Gaussians.
  std::size_t size() const;
  /// Its metadata: a file without Gaussians, but with their degree.
  const SceneFile &head() const;
  /// Writes the Gaussians to \p To, of the same degree, the first of them to
  /// place \p At. Called once. Refused: indices outside codebook or palette.
  Expected<Success> unpack(Scene &To, std::size_t At);

private:
  class Reader;
  explicit SogData(std::unique_ptr<Reader> TheReader);
  std::unique_ptr<Reader> Own;
};

/// The complete data set of \c SogData.
Expected<SceneFile> parseSogData(const std::string &Where,
                                 const std::string &MetaWhere, Bytes Meta,
                                 const FileSource &Read);

} // namespace vorion::splat
