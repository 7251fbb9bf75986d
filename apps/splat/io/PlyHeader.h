/// The header of a PLY file: its elements and where their properties lie.
#pragma once

#include "io/Bytes.h"
#include "vorion/support/Expected.h"

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// What the readers tell apart; \c Other is any scalar that they only skip.
enum class PlyType { Float, UInt, UChar, Other };

/// A scalar property: where it lies in each row of its element.
struct PlyProperty {
  std::string Name;
  std::size_t Offset = 0;
  PlyType Type = PlyType::Other;
};

struct PlyElement {
  std::string Name;
  std::size_t Count = 0;
  std::size_t Stride = 0; ///< bytes of a row
  std::size_t Start = 0;  ///< of the first row, bytes from the file's start
  std::vector<PlyProperty> Properties;

  /// Appends a property of \p Size bytes; false if there is one of its name.
  bool add(std::string_view Property, PlyType Type, std::size_t Size);
  const PlyProperty *find(std::string_view Property) const;
  /// The offsets in a row of \p Names, which must all have type \p Type.
  Expected<std::vector<std::size_t>>
  offsets(const std::string &Where, const std::vector<std::string> &Names,
          PlyType Type) const;

private:
  std::map<std::string, std::size_t, std::less<>> Places; ///< in Properties
};

struct PlyHeader {
  std::vector<PlyElement> Elements;
  std::vector<std::string> Comments; ///< without their keyword

  /// Appends an element; null if there is one of its name.
  PlyElement *add(std::string_view Element);
  const PlyElement *find(std::string_view Element) const;

private:
  std::map<std::string, std::size_t, std::less<>> Places; ///< in Elements
};

/// Whether \p File begins as PLYs do.
inline bool isPlyFile(Bytes File) {
  const std::string_view Text = asText(File);
  return Text.starts_with("ply\n") || Text.starts_with("ply\r");
}

/// Reads the header of a binary little-endian PLY of scalar properties; \p File
/// holds exactly the rows that it declares, or the result is an error. Errors
/// of the header name the line. A header may declare any number of things, so
/// nothing here looks through all of them for each.
Expected<PlyHeader> readPlyHeader(const std::string &Where, Bytes File);

} // namespace vorion::splat
