#include "vorion/support/FileKind.h"

#include "vorion/support/File.h"
#include "vorion/support/Letters.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstring>
#include <elf.h>
#include <fmt/format.h>
#include <optional>

namespace vorion {
namespace {

using namespace std::string_view_literals;

/// As much of a file as is looked at.
constexpr std::size_t Looked = 4096;

std::string_view textOf(std::span<const std::byte> File) {
  return {reinterpret_cast<const char *>(File.data()),
          std::min(File.size(), Looked)};
}

struct Record {
  FileUse Use;
  std::string_view Name;
};
constexpr Record Records[] = {
#define FILE_KIND(ID, USE, NAME) {FileUse::USE, NAME},
#include "vorion/support/FileKinds.def"
};

/// How a kind is known, by the lists of FileKinds.def.
struct Mark {
  FileKind Kind;
  std::size_t At;
  std::string_view Bytes;
};
constexpr Mark Marks[] = {
#define FILE_MARK(ID, AT, BYTES) {FileKind::ID, AT, BYTES##sv},
#include "vorion/support/FileKinds.def"
};
static_assert(std::ranges::all_of(Marks,
                                  [](const Mark &M) {
                                    return M.Bytes.size() >= 3;
                                  }),
              "a file without magic bytes matches by chance");

bool fits(const Mark &M, std::string_view Start) {
  return Start.size() > M.At && Start.substr(M.At).starts_with(M.Bytes);
}

struct Word {
  FileKind Kind;
  std::string_view Text;
};
constexpr Word Lines[] = {
#define FILE_LINE(ID, BEGINNING) {FileKind::ID, BEGINNING},
#include "vorion/support/FileKinds.def"
};
constexpr Word Keys[] = {
#define FILE_KEY(ID, KEY) {FileKind::ID, KEY},
#include "vorion/support/FileKinds.def"
};
constexpr Word Entries[] = {
#define FILE_ENTRY(ID, ENDING) {FileKind::ID, ENDING},
#include "vorion/support/FileKinds.def"
};

/// The number of type \p T at \p At of \p Start; nothing beyond its end.
template <typename T>
std::optional<T> numberAt(std::string_view Start, std::size_t At) {
  if (At > Start.size() || Start.size() - At < sizeof(T))
    return std::nullopt;
  T Value;
  std::memcpy(&Value, Start.data() + At, sizeof(T));
  return Value;
}

/// Whether number \p At of \p Start is there and \p Fits.
template <typename T, typename Predicate>
bool holds(std::string_view Start, std::size_t At, Predicate Fits) {
  const auto Value = numberAt<T>(Start, At);
  return Value && Fits(*Value);
}

/// \name Kinds whose mark is short, or who have none
/// @{
bool isBmp(std::string_view Start) {
  // Two numbers behind the file's size are 0; then where pixels begin, and the
  // size of one of the few headers.
  return Start.starts_with("BM") &&
         holds<uint32_t>(Start, 6, [](uint32_t V) { return V == 0; }) &&
         holds<uint32_t>(Start, 14, [](uint32_t V) {
           return V == 12 || V == 40 || V == 108 || V == 124;
         });
}

bool isPe(std::string_view Start) {
  constexpr std::size_t PlaceOfHeader = 0x3c;
  const auto At = numberAt<uint32_t>(Start, PlaceOfHeader);
  return Start.starts_with("MZ") && At && *At < Start.size() &&
         Start.substr(*At).starts_with("PE\0\0"sv);
}

/// Programs of several machines for macOS, and classes of Java, which begin
/// alike: then comes how many machines, or a version above 44.
std::optional<FileKind> kindOfCafe(std::string_view Start) {
  if (!Start.starts_with("\xca\xfe\xba\xbe") || Start.size() < 8)
    return std::nullopt;
  const bool IsFew = Start.substr(4, 3) == "\0\0\0"sv && Start[7] < 45;
  return IsFew ? FileKind::MachO : FileKind::JavaClass;
}

bool isSafetensors(std::string_view Start) {
  constexpr uint64_t Most = uint64_t{100} << 20; // the format's own bound
  return holds<uint64_t>(Start, 0,
                         [](uint64_t V) { return V > 1 && V <= Most; }) &&
         Start.substr(8).starts_with("{\"");
}

bool isOnnx(std::string_view Start) {
  // Fields of Protocol Buffers: the version, and who made it, a short text.
  if (Start.size() < 8 || Start[0] != 0x08 || Start[1] < 1 || Start[1] > 30 ||
      Start[2] != 0x12 || Start[3] < 3 || Start[3] > 60)
    return false;
  const std::string_view Maker =
      Start.substr(4, static_cast<std::size_t>(Start[3]));
  return std::ranges::all_of(Maker,
                             [](char C) { return C >= ' ' && C < 0x7f; });
}

/// COLMAP's files begin with a count, and then with a first record: of a
/// camera, a model and its size; of an image, a rotation of length 1; of a
/// point, three finite numbers that are not all small.
std::optional<FileKind> kindOfColmap(std::string_view Start) {
  constexpr uint64_t Most = uint64_t{1} << 32;
  if (!holds<uint64_t>(Start, 0, [](uint64_t V) { return V > 0 && V < Most; }))
    return std::nullopt;
  constexpr uint32_t Models = 20; // it has 11 to 17
  constexpr uint64_t LargestSide = 1 << 17;
  const auto IsSide = [](uint64_t V) { return V > 0 && V < LargestSide; };
  if (holds<uint32_t>(Start, 12, [](uint32_t V) { return V < Models; }) &&
      holds<uint64_t>(Start, 16, IsSide) && holds<uint64_t>(Start, 24, IsSide))
    return FileKind::ColmapCameras;
  const auto SumOfSquares = [Start](std::size_t At, std::size_t Count) {
    double Sum = 0;
    for (std::size_t I = 0; I != Count; ++I)
      Sum += std::pow(numberAt<double>(Start, At + 8 * I).value_or(NAN), 2);
    return Sum;
  };
  if (std::abs(SumOfSquares(12, 4) - 1) < 1e-6)
    return FileKind::ColmapImages;
  const double Far = SumOfSquares(16, 3);
  constexpr double Least = 1e-12, Furthest = 1e12;
  if (holds<uint64_t>(Start, 8, [](uint64_t V) { return V < Most; }) &&
      Far > Least && Far < Furthest &&
      holds<double>(
          Start, 43, [](double V) { return V >= 0 && V < 1e6; }) &&
      holds<uint64_t>(
          Start, 51, [](uint64_t V) { return V >= 2 && V < 1 << 20; }))
    return FileKind::ColmapPoints;
  return std::nullopt;
}

/// A text of two or four bytes a letter, with a mark of the order of bytes or
/// without one.
std::optional<FileKind> kindOfWideText(std::string_view Start) {
  if (Start.starts_with("\xff\xfe\0\0"sv) ||
      Start.starts_with("\0\0\xfe\xff"sv))
    return FileKind::Utf32;
  const bool IsMarked =
      Start.starts_with("\xff\xfe") || Start.starts_with("\xfe\xff");
  const std::size_t Least = IsMarked ? 1 : 4;
  constexpr std::size_t Most = 64; // letters
  const std::string_view Shown = Start.substr(IsMarked ? 2 : 0, 2 * Most);
  if (Shown.size() < 2 * Least)
    return std::nullopt;
  // In most texts one byte of nearly every letter is 0, always the same one.
  for (const std::size_t High : {0, 1}) {
    std::size_t Letters = 0;
    for (std::size_t I = 0; I + 1 < Shown.size(); I += 2)
      Letters += Shown[I + High] == 0 && Shown[I + 1 - High] >= '\t' &&
                 Shown[I + 1 - High] != 0x7f;
    if (Letters == Shown.size() / 2 ||
        (IsMarked && 2 * Letters >= Shown.size() / 2))
      return FileKind::Utf16;
  }
  return std::nullopt;
}
/// @}

/// The first line of \p Text that is not empty and, if so wanted, no comment.
std::string_view firstLine(std::string_view Text, bool SkipComments) {
  while (!Text.empty()) {
    const std::size_t End = std::min(Text.find('\n'), Text.size());
    const std::string_view Line = trimmed(Text.substr(0, End), " \t\r\f");
    if (!Line.empty() && !(SkipComments && Line.starts_with('#')))
      return Line;
    Text.remove_prefix(std::min(End + 1, Text.size()));
  }
  return {};
}

FileKind kindOfText(std::string_view Text) {
  const std::string_view First = firstLine(Text, false),
                         Later = firstLine(Text, true);
  if (First.starts_with('{'))
    return objectKindOf([Text](std::string_view Key) {
      return Text.find(fmt::format("\"{}\"", Key)) != Text.npos;
    });
  const auto *Known = std::ranges::find_if(Lines, [&](const Word &W) {
    return First.starts_with(W.Text) || Later.starts_with(W.Text);
  });
  return Known == std::end(Lines) ? FileKind::PlainText : Known->Kind;
}

/// Of a zip archive, by the name of its first entry.
FileKind kindOfZip(std::string_view Start) {
  constexpr std::size_t LengthAt = 26, NameAt = 30;
  const auto Length = numberAt<uint16_t>(Start, LengthAt);
  if (!Start.starts_with("PK\x03\x04") || !Length || Start.size() < NameAt)
    return FileKind::Zip;
  return archiveKindOf({std::string(Start.substr(NameAt, *Length))});
}

/// "x86-64", by the number that an ELF file has for it.
std::string machineName(unsigned Machine) {
  static constexpr std::pair<unsigned, const char *> Names[] = {
      {EM_386, "x86"},         {EM_X86_64, "x86-64"}, {EM_ARM, "Arm"},
      {EM_AARCH64, "AArch64"}, {EM_RISCV, "RISC-V"},  {EM_MIPS, "MIPS"},
      {EM_PPC, "PowerPC"},     {EM_PPC64, "PowerPC"}, {EM_S390, "S/390"},
      {EM_SPARC, "SPARC"},     {EM_SPARCV9, "SPARC"}, {EM_CUDA, "CUDA"},
      {EM_AMDGPU, "AMD GPUs"}, {EM_BPF, "BPF"},       {EM_AVR, "AVR"},
      {EM_XTENSA, "Xtensa"},   {EM_IA_64, "IA-64"}};
  const auto *Known = std::ranges::find(
      Names, Machine, [](const auto &Each) { return Each.first; });
  return Known == std::end(Names) ? fmt::format("machine number {}", Machine)
                                  : Known->second;
}

/// What the header of an ELF file says.
struct ElfFacts {
  unsigned Type = 0, Machine = 0;
  bool Is64 = false, IsBig = false;
  bool isOurs() const { return Machine == EM_RISCV && !Is64 && !IsBig; }
};

std::optional<ElfFacts> factsOfElf(std::string_view Start) {
  constexpr std::size_t TypeAt = 16, MachineAt = 18;
  if (Start.size() < MachineAt + 2)
    return std::nullopt;
  ElfFacts F;
  F.Is64 = Start[EI_CLASS] != ELFCLASS32;
  F.IsBig = Start[EI_DATA] != ELFDATA2LSB;
  const auto Half = [&](std::size_t At) {
    const auto Low = static_cast<unsigned char>(Start[At + F.IsBig]);
    const auto High = static_cast<unsigned char>(Start[At + !F.IsBig]);
    return 256U * High + Low;
  };
  F.Type = Half(TypeAt);
  F.Machine = Half(MachineAt);
  return F;
}

std::string describeElf(const ElfFacts &F) {
  static constexpr std::array Types{"file", "object", "executable",
                                    "shared library", "core dump"};
  return fmt::format("an ELF {} for {} ({}-bit{})",
                     F.Type < Types.size() ? Types[F.Type] : Types[0],
                     machineName(F.Machine), F.Is64 ? 64 : 32,
                     F.IsBig ? ", big-endian" : "");
}

} // namespace

bool isText(std::span<const std::byte> File) {
  const std::string_view Start = textOf(File);
  std::size_t Others = 0;
  for (const char C : Start) {
    const auto Byte = static_cast<unsigned char>(C);
    if (Byte == 0x7f || (Byte < ' ' && "\t\n\r\f"sv.find(C) == Start.npos))
      return false;
    Others += Byte > 0x7f;
  }
  return !Start.empty() && 8 * Others <= Start.size();
}

FileKind fileKindOf(std::span<const std::byte> File) {
  const std::string_view Start = textOf(File);
  if (Start.empty())
    return FileKind::Empty;
  // Further on, an archive may have a member's name that is another's mark.
  for (const bool AtBeginning : {true, false}) {
    const auto *Known = std::ranges::find_if(Marks, [&](const Mark &M) {
      return (M.At == 0) == AtBeginning && fits(M, Start);
    });
    if (Known != std::end(Marks))
      return Known->Kind == FileKind::Zip ? kindOfZip(Start) : Known->Kind;
  }
  constexpr std::string_view ByteOrderMark = "\xef\xbb\xbf";
  const std::size_t Before =
      Start.starts_with(ByteOrderMark) ? ByteOrderMark.size() : 0;
  if (isText(File.subspan(Before)))
    return kindOfText(Start.substr(Before));
  if (isBmp(Start))
    return FileKind::Bmp;
  if (isPe(Start))
    return FileKind::Pe;
  if (isSafetensors(Start))
    return FileKind::Safetensors;
  if (isOnnx(Start))
    return FileKind::Onnx;
  for (auto *const Other : {kindOfCafe, kindOfWideText, kindOfColmap})
    if (const auto Kind = Other(Start))
      return *Kind;
  return FileKind::Unknown;
}

bool hasMark(FileKind K, std::span<const std::byte> File) {
  return std::ranges::any_of(Marks, [&](const Mark &M) {
    return M.Kind == K && fits(M, textOf(File));
  });
}

FileKind archiveKindOf(const std::vector<std::string> &Names) {
  return std::ranges::find_if(Entries,
                              [&](const Word &W) {
                                return W.Text.empty() ||
                                       std::ranges::any_of(
                                           Names, [&](const std::string &Name) {
                                             return Name.ends_with(W.Text);
                                           });
                              })
      ->Kind;
}

FileKind objectKindOf(const std::function<bool(std::string_view)> &Has) {
  return std::ranges::find_if(
             Keys, [&](const Word &W) { return W.Text.empty() || Has(W.Text); })
      ->Kind;
}

std::string_view name(FileKind K) {
  assert(K != FileKind::Unknown && "it has none");
  return Records[static_cast<std::size_t>(K)].Name;
}

FileUse useOf(FileKind K, std::span<const std::byte> File) {
  if (K == FileKind::Unknown)
    return FileUse::Nothing;
  if (K == FileKind::Elf)
    if (const auto F = factsOfElf(textOf(File)); F && !F->isOurs())
      return FileUse::OtherProgram;
  return Records[static_cast<std::size_t>(K)].Use;
}

bool mayBeJson(FileKind K) {
  return K == FileKind::Unknown || K == FileKind::PlainText ||
         K == FileKind::JsonList ||
         std::ranges::find(Keys, K, &Word::Kind) != std::end(Keys);
}

std::string describe(FileKind K, std::span<const std::byte> File) {
  if (K == FileKind::Elf)
    if (const auto F = factsOfElf(textOf(File)))
      return describeElf(*F);
  return std::string(name(K));
}

std::string_view adviceFor(FileUse U) {
  switch (U) {
  case FileUse::Nothing:
    return "";
  case FileUse::Picture:
    return "`splat compare` and `splat train` take pictures";
  case FileUse::OtherPicture:
    return "`splat compare` and `splat train` take it as PNG";
  case FileUse::Film:
    return "`splat train` reads its frames as a capture of pictures";
  case FileUse::Scene:
    return "`splat render` and `splat convert` read scenes";
  case FileUse::MovingScene:
    return "`splat render` reads one time step of it as .ply";
  case FileUse::Model:
  case FileUse::Weights:
    return "`splat render` reads Gaussians exported from it as .ply";
  case FileUse::Points:
    return "`splat train` trains from captures, not from these";
  case FileUse::Captured:
    return "`splat train` reads the folder of the capture";
  case FileUse::Cameras:
    return "`splat render` reads it with --cameras";
  case FileUse::Archive:
  case FileUse::Packed:
    return "unpack it, and use the file in it";
  case FileUse::Folder:
    return "unpack it, and use the folder";
  case FileUse::Program:
    return "`vorion-sim` and `vorion-objdump` read programs of the machine";
  case FileUse::Objects:
    return "`vorion-link` takes objects";
  case FileUse::OtherProgram:
  case FileUse::Code:
    return "`vorion-clang` compiles sources for the machine";
  case FileUse::OwnCheckpoint:
    return "`splat train --resume` continues from it";
  case FileUse::OwnRegion:
    return "`vorion-sim` repeats it";
  case FileUse::OwnReport:
    return "`splat replay` reproduces it, and `splat compare --times` compares "
           "times";
  case FileUse::OtherText:
    return "save it as UTF-8";
  case FileUse::Pointer:
    return "fetch the file itself with `git lfs pull`";
  case FileUse::Page:
    return "download the file itself, perhaps by another link";
  }
  return "";
}

Error otherKind(const std::string &Where, std::span<const std::byte> File,
                std::string_view Wanted, std::string_view Otherwise) {
  const FileKind K = fileKindOf(File);
  if (K == FileKind::Unknown)
    return {Where, fmt::format("{}, expected {}", Otherwise, Wanted)};
  const std::string_view Advice = adviceFor(useOf(K, File));
  return {Where, fmt::format("{}, expected {}{}{}", describe(K, File), Wanted,
                             Advice.empty() ? "" : "; ", Advice)};
}

Error otherKindAt(const std::string &Path, std::string_view Wanted,
                  std::string_view Otherwise) {
  // What a pipe has would be lost.
  const auto Start = readStart(Path, Looked);
  return Start ? otherKind(Path, *Start, Wanted, Otherwise)
               : Error{Path, fmt::format("{}, expected {}", Otherwise, Wanted)};
}

} // namespace vorion
