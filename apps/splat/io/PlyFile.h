/// The rows of a PLY file in any encoding.
#pragma once

#include "io/PlyHeader.h"

#include <utility>

namespace vorion::splat {

/// A PLY with access to its rows as little-endian binary.
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

  /// The bytes from row 0 of \p Element on.
  Bytes from(const PlyElement &Element) const {
    return Rows.subspan(Element.Start);
  }

private:
  PlyHeader Header;
  std::vector<std::byte> Own;
  Bytes Rows;
};

/// The number of type \p Type at \p At of a row.
double loadNumber(Bytes Row, std::size_t At, PlyType Type);

/// The rows of an element that may have lists, which have no fixed size: from
/// the first one on, property by property.
class PlyListRows {
public:
  /// \p File must outlive this.
  PlyListRows(const PlyFile &File, const PlyElement &Element)
      : Rows(File.from(Element)) {}

  /// Passes \p Property, which is the next one of the row or, after the last
  /// one, the first of the next row; appends its numbers to \p To if that is
  /// not null.
  void next(const PlyProperty &Property, std::vector<double> *To);

private:
  Bytes Rows;
  std::size_t At = 0;
};

/// The number at \p At of a row.
inline double loadReal(Bytes Row, PlyReal At) {
  return At.IsDouble ? load<double>(Row, At.Offset)
                     : double{load<float>(Row, At.Offset)};
}

/// Reads a PLY. Error: \p File does not contain exactly the rows that its
/// header declares. Errors in the header and in text name the line. Memory is
/// proportional to the file's size: rows of text take at most four times as
/// much.
Expected<PlyFile> readPly(const std::string &Where, Bytes File);

} // namespace vorion::splat
