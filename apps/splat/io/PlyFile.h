/// The rows of a PLY file in any encoding.
#pragma once

#include "io/PlyHeader.h"

#include <utility>

namespace vorion::splat {

/// A PLY with access to its rows as little-endian binary. Rows of an element
/// with lists are validated and skipped.
class PlyFile {
public:
  /// Rows of a little-endian binary file are not copied, so \p File must
  /// outlive this.
  PlyFile(PlyHeader Header, Bytes File)
      : Header(std::move(Header)), Rows(File) {}
  PlyFile(PlyHeader Header, std::vector<std::byte> Converted)
      : Header(std::move(Header)), Own(std::move(Converted)), Rows(Own) {}
  PlyFile(PlyFile &&) = default;
  PlyFile &operator=(PlyFile &&) = default;

  const PlyHeader &header() const { return Header; }

  /// Row \p I of \p Element of this file, which has no lists.
  Bytes row(const PlyElement &Element, std::size_t I) const {
    assert(!Element.HasLists && I < Element.Count);
    return Rows.subspan(Element.Start + I * Element.Stride, Element.Stride);
  }

private:
  PlyHeader Header;
  std::vector<std::byte> Own;
  Bytes Rows;
};

/// The number at \p At of a row. A double is rounded to the nearest float.
inline float loadReal(Bytes Row, PlyReal At) {
  return At.IsDouble ? static_cast<float>(load<double>(Row, At.Offset))
                     : load<float>(Row, At.Offset);
}

/// Reads a PLY. Error: \p File does not contain exactly the rows that its
/// header declares. Errors in the header and in text name the line. Memory is
/// proportional to the file's size: rows of text take at most four times as
/// much.
Expected<PlyFile> readPly(const std::string &Where, Bytes File);

} // namespace vorion::splat
