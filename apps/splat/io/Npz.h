/// NumPy's .npz: named arrays in a zip archive.
#pragma once

#include "vorion/support/Expected.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// One array, C order, little endian.
struct NpyArray {
  /// NumPy's name of the element type without byte order: "f4", "f8", "i2",
  /// "i4", "i8", "u1", "u2", "u4", "b1"; "U<n>" for text of n code points.
  std::string Type;
  std::vector<std::size_t> Shape; ///< empty for a scalar
  std::vector<std::byte> Bytes;

  std::size_t elements() const;
  /// The elements converted to double; empty for text.
  std::vector<double> toDoubles() const;
  /// The elements converted to float; empty for text.
  std::vector<float> toFloats() const;
  /// The elements of an array of integers; empty for others.
  std::vector<int64_t> toIntegers() const;
  /// The texts of a "U<n>" array, as toText(); empty for others.
  std::vector<std::string> toTexts() const;
  /// The text of a scalar "U<n>" array (ASCII; other code points become '?').
  std::string toText() const;

  static NpyArray of(std::vector<std::size_t> Shape,
                     const std::vector<float> &Values);
  static NpyArray of(std::vector<std::size_t> Shape,
                     const std::vector<double> &Values);
  static NpyArray of(std::vector<std::size_t> Shape,
                     const std::vector<int32_t> &Values);
  /// Of type "b1".
  static NpyArray fromBools(std::vector<std::size_t> Shape,
                            const std::vector<uint8_t> &Values);
};

using Npz = std::map<std::string, NpyArray>;

/// Type and shape of an array that is not yet unpacked.
struct NpyShape {
  std::string Type;               ///< as NpyArray has it
  std::vector<std::size_t> Shape; ///< likewise

  /// Number of elements; 0 for text.
  std::size_t numbers() const;
};

/// A file whose arrays are unpacked individually, because they may be a
/// thousand times as large as the file, and a reader can reject them by their
/// shapes. Errors: not a zip archive, big endian, element types not listed
/// above, sizes that do not match the shape.
class NpzFile {
public:
  static Expected<NpzFile> open(const std::string &Path);
  NpzFile(NpzFile &&) noexcept;
  ~NpzFile();

  const std::map<std::string, NpyShape> &shapes() const;
  /// Shape of the array \p Name; null if there is none.
  const NpyShape *find(const std::string &Name) const;
  /// The array \p Name, one of shapes(). Fortran order becomes C order.
  Expected<NpyArray> read(const std::string &Name);

private:
  struct Content;
  explicit NpzFile(std::unique_ptr<Content> TheContent);
  std::unique_ptr<Content> Own;
};

/// All arrays of \p Path.
Expected<Npz> readNpz(const std::string &Path);

/// Parses one .npy file; \p Where names it in errors.
Expected<NpyArray> parseNpy(const std::string &Where,
                            std::vector<std::byte> Bytes);

/// Writes \p Arrays deflated, in the order of their names.
Expected<Success> writeNpz(const std::string &Path, const Npz &Arrays);

} // namespace vorion::splat
