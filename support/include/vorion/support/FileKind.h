/// Recognition of file kinds by content, for messages of a reader about an
/// unexpected kind. FileKinds.def lists the kinds.
#pragma once

#include "vorion/support/Expected.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vorion {

enum class FileKind : uint8_t {
#define FILE_KIND(ID, USE, NAME) ID,
#include "vorion/support/FileKinds.def"
  Unknown
};

/// The use of a kind of file in this project, which determines the hint in a
/// message.
enum class FileUse : uint8_t {
  Nothing,
  Picture,      ///< of a kind that we read
  OtherPicture, ///< of another kind
  Film,
  Scene, ///< of Gaussians, or it may be
  MovingScene,
  Model,         ///< of a program that draws; may hold Gaussians
  Points,        ///< a point cloud or a mesh
  Captured,      ///< a part of a capture
  Cameras,       ///< views
  Weights,       ///< arrays, and networks; may hold Gaussians
  Archive,       ///< of files
  Folder,        ///< an archive whose names belong into a folder
  Packed,        ///< one file
  Program,       ///< for our machine
  Objects,       ///< to be linked
  OtherProgram,  ///< for another machine
  Code,          ///< to be compiled
  OwnCheckpoint, ///< of `splat train`
  OwnRegion,     ///< of `vorion-sim --region`
  OwnReport,     ///< any `--json`
  OtherText,     ///< in an encoding that we do not read
  Pointer,       ///< to the file itself
  Page           ///< instead of the file itself
};

/// The kind of a file that begins with \p File, of which at most 4096 bytes are
/// examined. Unknown for formats without magic bytes, such as `.splat`.
FileKind fileKindOf(std::span<const std::byte> File);

/// Whether \p File has the magic bytes of \p K; false for kinds without magic
/// bytes.
bool hasMark(FileKind K, std::span<const std::byte> File);

/// The kind of a zip archive with the entries \p Names.
FileKind archiveKindOf(const std::vector<std::string> &Names);

/// The kind of a JSON object, where \p Has tests for a key.
FileKind objectKindOf(const std::function<bool(std::string_view)> &Has);

/// Whether \p File looks like text: no control characters, and few characters
/// outside ASCII.
bool isText(std::span<const std::byte> File);

/// "a picture (PNG)". Not for Unknown.
std::string_view name(FileKind K);

/// For an ELF file, \p File determines whether it is for our machine.
FileUse useOf(FileKind K, std::span<const std::byte> File = {});

/// Whether a damaged file of kind \p K may be malformed JSON, about which its
/// reader has a better message.
bool mayBeJson(FileKind K);

/// Detailed description of the file \p File of kind \p K: "an ELF executable
/// for x86-64 (64-bit)". Otherwise its name.
std::string describe(FileKind K, std::span<const std::byte> File);

/// A hint for a file of use \p U, a clause without a full stop; empty if there
/// is none.
std::string_view adviceFor(FileUse U);

/// The error of a reader that expected \p Wanted and not the kind of \p File,
/// with the name \p Where: "a picture (PNG), expected a program; ...". \p
/// Otherwise is used if the kind is unknown: "not an ELF file".
Error otherKind(const std::string &Where, std::span<const std::byte> File,
                std::string_view Wanted, std::string_view Otherwise);

/// The same for the file \p Path, whose content has not been read. The kind of
/// unreadable and non-regular files is unknown.
Error otherKindAt(const std::string &Path, std::string_view Wanted,
                  std::string_view Otherwise);

} // namespace vorion
