/// What a file is, by its content: for messages of a reader that was given
/// another kind than it reads. FileKinds.def has the kinds.
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

/// For what a file is of use here: on that depends what its owner is told.
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

/// The kind of a file that begins with \p File: no more than 4096 bytes are
/// looked at, so that it need not be whole. Unknown for what has no mark, such
/// as a `.splat`.
FileKind fileKindOf(std::span<const std::byte> File);

/// Whether \p File has a mark of \p K, for readers of that kind. Kinds without
/// a mark have none.
bool hasMark(FileKind K, std::span<const std::byte> File);

/// The kind of a zip archive with the entries \p Names.
FileKind archiveKindOf(const std::vector<std::string> &Names);

/// The kind of an object in JSON, of which \p Has says whether it has a key.
FileKind objectKindOf(const std::function<bool(std::string_view)> &Has);

/// Whether \p File begins as a text: no control characters, and few letters
/// beyond ASCII. The bytes of numbers soon differ.
bool isText(std::span<const std::byte> File);

/// "a picture (PNG)". Not of Unknown.
std::string_view name(FileKind K);

/// Of an ELF file, \p File says whether it is for our machine.
FileUse useOf(FileKind K, std::span<const std::byte> File = {});

/// Whether a file of kind \p K, which is damaged, may have been meant as JSON:
/// then its reader says more than what kind it is.
bool mayBeJson(FileKind K);

/// What the file \p File of kind \p K is in more detail: "an ELF executable
/// for x86-64 (64-bit)". Otherwise its name.
std::string describe(FileKind K, std::span<const std::byte> File);

/// What the owner of a file of use \p U may do, a clause without a full stop;
/// empty where it is of no use.
std::string_view adviceFor(FileUse U);

/// The error of a reader that \p Wanted another kind than \p File, whose name
/// is \p Where: "a picture (PNG), expected a program; ...". If the kind is not
/// known, \p Otherwise stands for it: "not an ELF file".
Error otherKind(const std::string &Where, std::span<const std::byte> File,
                std::string_view Wanted, std::string_view Otherwise);

/// The same of the file \p Path, which nobody has read. Of what is no regular
/// file, or cannot be read, the kind is not known.
Error otherKindAt(const std::string &Path, std::string_view Wanted,
                  std::string_view Otherwise);

} // namespace vorion
