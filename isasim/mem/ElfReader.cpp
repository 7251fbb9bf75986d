#include "mem/ElfReader.h"

#include "core/Isa.h"
#include "vorion/support/FileKind.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <fmt/format.h>
#include <tuple>
#include <utility>

namespace vorion::isasim {

namespace {

// RISC-V ELF psABI, "File header"; elf.h of older systems lacks some.
constexpr uint32_t FlagCompressed = 0x1;
constexpr uint32_t FlagFloatAbi = 0x6;
// Soft-float programs only pass floats differently among themselves.
constexpr uint32_t FloatAbiSoft = 0x0, FloatAbiSingle = 0x2;
constexpr uint32_t FlagRve = 0x8;

constexpr const char *KernelSection = "vorion_kernels";
constexpr const char *VariableSection = "vorion_variables";
constexpr const char *WarpsSection = "vorion_warps";
/// What runs around main() (libdevice/cxx/static_objects.c): kernels never do.
constexpr const char *StaticObjectsSection = "vorion_static_objects";
constexpr const char *AtomicsSection = "vorion_atomics";
constexpr uint32_t MaxArgs = 4096; ///< more than OpenCL's 256 KiB could hold
constexpr uint32_t MaxArgsBytes = 256 << 10;

// Many entries may name the same bytes of a file. What comes of them together
// is bounded by the file's size, with room for what programs really share.
constexpr size_t NameBytesPerByte = 4; ///< an ending of a longer name
constexpr size_t BytesPerArg = 4;      ///< a table of arguments

} // namespace

std::optional<std::span<const std::byte>>
ImageParser::part(uint64_t Offset, uint64_t Bytes) const {
  if (Offset > File.size() || Bytes > File.size() - Offset)
    return std::nullopt;
  return File.subspan(Offset, Bytes);
}

template <typename T> std::optional<T> ImageParser::get(uint64_t Offset) const {
  const auto Bytes = part(Offset, sizeof(T));
  if (!Bytes)
    return std::nullopt;
  T Value;
  std::memcpy(&Value, Bytes->data(), sizeof(T));
  return Value;
}

template <typename T>
std::optional<T> ImageParser::load(uint32_t Address) const {
  const auto Bytes = Result->bytesAt(Address, sizeof(T));
  if (Bytes.size() != sizeof(T))
    return std::nullopt;
  T Value;
  std::memcpy(&Value, Bytes.data(), sizeof(T));
  return Value;
}

std::optional<std::string> ImageParser::loadString(uint32_t Address) {
  const Image::Segment *S = Result->segmentAt(Address);
  if (!S || Address - S->Address >= S->Bytes.size())
    return std::nullopt;
  const std::span Rest = std::span(S->Bytes).subspan(Address - S->Address);
  const auto *First = reinterpret_cast<const char *>(Rest.data());
  const size_t Length = strnlen(First, Rest.size());
  if (Length == Rest.size() || !countName(Length))
    return std::nullopt;
  return std::string(First, Length);
}

bool ImageParser::countName(size_t Bytes) {
  NameBytes += Bytes;
  return NameBytes <= NameBytesPerByte * File.size();
}

bool ImageParser::isCode(uint32_t Address) const {
  const Image::Segment *S = Result->segmentAt(Address);
  return Address % 4 == 0 && S && S->Executable;
}

std::string ImageParser::readHeader() {
  const auto H = get<Elf32_Ehdr>(0);
  if (!H && fileKindOf(File) == FileKind::Elf)
    return "truncated: the header lies beyond the end of the file";
  if (!H || std::memcmp(H->e_ident, ELFMAG, SELFMAG) != 0 ||
      H->e_ident[EI_CLASS] != ELFCLASS32 ||
      H->e_ident[EI_DATA] != ELFDATA2LSB || H->e_machine != EM_RISCV)
    return otherKind("", File, "an ELF executable for RISC-V (32-bit)",
                     "not an ELF file")
        .What;
  Header = *H;
  if (Header.e_ident[EI_VERSION] != EV_CURRENT ||
      Header.e_version != EV_CURRENT)
    return fmt::format("ELF version {}, expected {}",
                       Header.e_ident[EI_VERSION] != EV_CURRENT
                           ? Header.e_ident[EI_VERSION]
                           : Header.e_version,
                       EV_CURRENT);
  if (Header.e_type != ET_EXEC)
    return fmt::format("ELF type {}, expected {} (executable); link the "
                       "object first",
                       Header.e_type, ET_EXEC);
  if (Header.e_flags & FlagCompressed)
    return "compressed instructions, expected code without the C extension";
  if (Header.e_flags & FlagRve)
    return "RV32E code, expected RV32I";
  const uint32_t FloatAbi = Header.e_flags & FlagFloatAbi;
  if (FloatAbi != FloatAbiSingle && FloatAbi != FloatAbiSoft)
    return "wrong floating-point ABI, expected ilp32f or ilp32";
  if (Header.e_phnum == 0 || Header.e_phentsize != sizeof(Elf32_Phdr))
    return "no program headers, expected a linked executable";
  return {};
}

std::string ImageParser::readSegments() {
  uint64_t Total = 0, FromFile = 0;
  for (unsigned N = 0; N != Header.e_phnum; ++N) {
    const auto P =
        get<Elf32_Phdr>(uint64_t{Header.e_phoff} + N * sizeof(Elf32_Phdr));
    if (!P)
      return "truncated: the program headers lie beyond the end of the file";
    if (P->p_type == PT_GNU_STACK)
      Result->MainStackBytes = P->p_memsz;
    if (P->p_type != PT_LOAD || P->p_memsz == 0)
      continue;
    const auto Bytes = part(P->p_offset, P->p_filesz);
    if (!Bytes)
      return fmt::format("truncated: segment {} lies beyond the end of the "
                         "file",
                         N);
    if (P->p_filesz > P->p_memsz)
      return fmt::format("segment {} is larger in the file than in memory", N);
    if (P->p_vaddr < VX_IMAGE_BASE ||
        uint64_t{P->p_vaddr} + P->p_memsz >
            uint64_t{VX_IMAGE_BASE} + VX_IMAGE_SIZE)
      return fmt::format("segment {} at 0x{:08x}, 0x{:x} bytes, expected it "
                         "within 0x{:08x} and 0x{:08x}",
                         N, P->p_vaddr, P->p_memsz, VX_IMAGE_BASE,
                         VX_IMAGE_BASE + VX_IMAGE_SIZE);
    FromFile += P->p_filesz;
    if (FromFile > File.size())
      return fmt::format("the segments up to number {} have {} bytes of a file "
                         "of {}, expected each byte in one segment",
                         N, FromFile, File.size());
    Total += P->p_memsz;
    if (Total > VX_IMAGE_SIZE)
      return fmt::format("the segments up to number {} overlap: 0x{:x} bytes, "
                         "expected at most 0x{:x}",
                         N, Total, VX_IMAGE_SIZE);
    Image::Segment S;
    S.Address = P->p_vaddr;
    S.MemBytes = P->p_memsz;
    S.Bytes.assign(Bytes->begin(), Bytes->end());
    S.Writable = (P->p_flags & PF_W) != 0;
    S.Executable = (P->p_flags & PF_X) != 0;
    Result->Segments.push_back(std::move(S));
  }
  return checkSegments();
}

std::string ImageParser::checkSegments() {
  std::vector<Image::Segment> &Segments = Result->Segments;
  std::sort(Segments.begin(), Segments.end(),
            [](const Image::Segment &A, const Image::Segment &B) {
              return A.Address < B.Address;
            });
  for (size_t N = 0; N != Segments.size(); ++N) {
    const Image::Segment &S = Segments[N];
    if (S.Writable && S.Executable)
      return fmt::format("the segment at 0x{:08x} is writable code, expected "
                         "code to be read-only",
                         S.Address);
    if (S.Executable && S.Address % 4 != 0)
      return fmt::format("the code segment at 0x{:08x} is not aligned to 4 "
                         "bytes",
                         S.Address);
    if (N && Segments[N - 1].Address + Segments[N - 1].MemBytes > S.Address)
      return fmt::format("the segments at 0x{:08x} and 0x{:08x} overlap",
                         Segments[N - 1].Address, S.Address);
  }
  if (!isCode(Header.e_entry))
    return fmt::format("entry point 0x{:08x}, expected the address of an "
                       "instruction in an executable segment",
                       Header.e_entry);
  Result->Entry = Header.e_entry;
  return {};
}

std::string ImageParser::readSections() {
  if (Header.e_shoff == 0 || Header.e_shnum == 0)
    return {}; // stripped of everything: no symbols, no kernels
  if (Header.e_shentsize != sizeof(Elf32_Shdr) ||
      Header.e_shstrndx >= Header.e_shnum)
    return "malformed section headers";
  auto Section = [&](unsigned N) {
    return get<Elf32_Shdr>(uint64_t{Header.e_shoff} + N * sizeof(Elf32_Shdr));
  };
  const auto Names = Section(Header.e_shstrndx);
  if (!Names || !part(Names->sh_offset, Names->sh_size))
    return "truncated: the section names lie beyond the end of the file";
  const auto SectionNames = *part(Names->sh_offset, Names->sh_size);
  bool HasSymbols = false;
  for (unsigned N = 0; N != Header.e_shnum; ++N) {
    const auto S = Section(N);
    if (!S)
      return "truncated: the section headers lie beyond the end of the file";
    if (S->sh_type == SHT_SYMTAB) {
      if (std::exchange(HasSymbols, true))
        return "more than one symbol table, expected one (gABI, \"Sections\")";
      if (std::string Wrong = readSymbols(*S); !Wrong.empty())
        return Wrong;
    }
    const auto IsCalled = [&](const char *Name) {
      const size_t Length = std::strlen(Name) + 1;
      return S->sh_name < SectionNames.size() &&
             SectionNames.size() - S->sh_name >= Length &&
             std::memcmp(SectionNames.data() + S->sh_name, Name, Length) == 0;
    };
    for (const auto &[Name, Table] :
         {std::pair(KernelSection, &KernelTable),
          std::pair(VariableSection, &VariableTable),
          std::pair(WarpsSection, &WarpsCode),
          std::pair(StaticObjectsSection, &StaticObjectsCode)})
      if (IsCalled(Name) && (S->sh_flags & SHF_ALLOC))
        *Table = {S->sh_addr, S->sh_addr + S->sh_size};
    if (IsCalled(AtomicsSection))
      if (std::string Wrong = readAtomicPlaces(*S); !Wrong.empty())
        return Wrong;
  }
  findBySymbols(KernelSection, KernelTable);
  findBySymbols(VariableSection, VariableTable);
  std::string Wrong = readKernels();
  if (Wrong.empty())
    Wrong = readVariables();
  return Wrong.empty() ? readWarps() : Wrong;
}

std::string ImageParser::readWarps() {
  if (WarpsCode.bytes() == 0)
    return {};
  const bool NeedsCore = needsCoreAlone();
  if (!isCode(WarpsCode.Lo))
    return fmt::format("section {} at 0x{:08x} is not code", WarpsSection,
                       WarpsCode.Lo);
  Result->WarpsEntry = WarpsCode.Lo;
  for (Kernel &K : Result->Kernels)
    K.SharesCore = !NeedsCore;
  return {};
}

std::string ImageParser::readAtomicPlaces(const Elf32_Shdr &Table) {
  const auto Words = part(Table.sh_offset, Table.sh_size);
  if (!Words)
    return fmt::format("truncated: section {} lies beyond the end of the file",
                       AtomicsSection);
  std::vector<uint32_t> &Places = Result->AtomicPlaces;
  // Sections share no bytes.
  if (Places.size() * sizeof(uint32_t) + Words->size() > File.size())
    return fmt::format("sections {} are larger than the file", AtomicsSection);
  for (uint32_t At = 0; At + sizeof(uint32_t) <= Words->size();
       At += sizeof(uint32_t))
    // Each word says how far from itself an instruction lies.
    Places.push_back(*get<uint32_t>(Table.sh_offset + At) + Table.sh_addr + At);
  std::ranges::sort(Places);
  return {};
}

bool ImageParser::needsCoreAlone() const {
  const auto Needs = [](uint32_t Word) {
    const std::optional<Decoded> D = decode(Word);
    if (!D)
      return false;
    const CsrInfo *Csr = findCsrInfo(D->Csr);
    // PoCL's barriers of a group, of number 0, wait for no other warp.
    return (D->Opcode == Op::VX_BAR && D->Rs1 != 0) || (Csr && Csr->Raster);
  };
  for (const Image::Segment &S : Result->Segments)
    for (size_t At = 0; S.Executable && At + 4 <= S.Bytes.size(); At += 4) {
      if (StaticObjectsCode.contains(S.Address + static_cast<uint32_t>(At)))
        continue;
      uint32_t Word = 0;
      std::memcpy(&Word, &S.Bytes[At], sizeof(Word));
      if (Needs(Word))
        return true;
    }
  return false;
}

void ImageParser::findBySymbols(const std::string &Name, Range &Table) const {
  const auto Lo = Result->findSymbol("__start_" + Name);
  const auto Hi = Result->findSymbol("__stop_" + Name);
  if (Table.bytes() == 0 && Lo && Hi)
    Table = {*Lo, *Hi};
}

std::string ImageParser::readSymbols(const Elf32_Shdr &Table) {
  const auto Strings = get<Elf32_Shdr>(uint64_t{Header.e_shoff} +
                                       Table.sh_link * sizeof(Elf32_Shdr));
  const auto Text = Strings && Table.sh_link < Header.e_shnum
                        ? part(Strings->sh_offset, Strings->sh_size)
                        : std::nullopt;
  const auto Entries = part(Table.sh_offset, Table.sh_size);
  if (!Text || !Entries)
    return "truncated: the symbol table lies beyond the end of the file";
  for (uint64_t N = 1; (N + 1) * sizeof(Elf32_Sym) <= Entries->size(); ++N) {
    const auto Sym = get<Elf32_Sym>(Table.sh_offset + N * sizeof(Elf32_Sym));
    const unsigned Type = ELF32_ST_TYPE(Sym->st_info);
    if (Sym->st_shndx == SHN_UNDEF || Sym->st_name >= Text->size() ||
        (Type != STT_NOTYPE && Type != STT_FUNC && Type != STT_OBJECT))
      continue;
    const auto *First =
        reinterpret_cast<const char *>(Text->data()) + Sym->st_name;
    std::string SymbolName(First, strnlen(First, Text->size() - Sym->st_name));
    // Mapping symbols ($x, $d) and the assembler's locals name nothing.
    if (SymbolName.empty() || SymbolName[0] == '$' ||
        SymbolName.starts_with(".L"))
      continue;
    if (!countName(SymbolName.size()))
      return fmt::format("symbols with names of more than {} bytes in a file "
                         "of {}",
                         NameBytesPerByte * File.size(), File.size());
    Result->Symbols.push_back({Sym->st_value, Sym->st_size, Type == STT_FUNC,
                               Sym->st_shndx == SHN_ABS,
                               std::move(SymbolName)});
  }
  std::sort(Result->Symbols.begin(), Result->Symbols.end(),
            [](const Image::Symbol &A, const Image::Symbol &B) {
              return std::tie(A.Address, A.Name) < std::tie(B.Address, B.Name);
            });
  return {};
}

std::string ImageParser::readKernels() {
  const auto [Lo, Hi] = KernelTable;
  if (Hi < Lo || KernelTable.bytes() % sizeof(VxKernel) != 0)
    return fmt::format("kernel table of {} bytes, expected a multiple of {}",
                       KernelTable.bytes(), sizeof(VxKernel));
  for (uint32_t At = Lo; At != Hi; At += sizeof(VxKernel))
    if (std::string Wrong = readKernel(At); !Wrong.empty())
      return Wrong;
  return {};
}

std::string ImageParser::readKernel(uint32_t Address) {
  const std::string Where = fmt::format("kernel table at 0x{:08x}: ", Address);
  const auto Record = load<VxKernel>(Address);
  if (!Record)
    return Where + "not in initialised memory";
  Kernel K;
  if (auto KernelName = loadString(Record->Name))
    K.Name = std::move(*KernelName);
  else
    return Where + "the name is not a string of the image";
  if (!isCode(Record->Entry))
    return Where + fmt::format("entry point 0x{:08x} of '{}' is not code",
                               Record->Entry, K.Name);
  if (Record->NumArgs > MaxArgs)
    return Where + fmt::format("'{}' has {} arguments, expected at most {}",
                               K.Name, Record->NumArgs, MaxArgs);
  if (Record->ArgsBytes > MaxArgsBytes)
    return Where + fmt::format("'{}' has {} bytes of arguments, expected at "
                               "most {}",
                               K.Name, Record->ArgsBytes, MaxArgsBytes);
  const auto *const Local = Record->LocalSize;
  const auto Zeros = std::count(Local, Local + 3, 0U);
  if (Zeros != 0 && Zeros != 3)
    return Where + fmt::format("'{}' was compiled for groups of {},{},{}, "
                               "expected three sizes above 0, or 0,0,0 for any",
                               K.Name, Local[0], Local[1], Local[2]);
  NumArgs += Record->NumArgs;
  if (NumArgs * BytesPerArg > File.size())
    return Where + fmt::format("{} kernel arguments in a file of {} bytes, "
                               "expected at most one per {} bytes",
                               NumArgs, File.size(), BytesPerArg);
  K.Entry = Record->Entry;
  K.ArgsBytes = Record->ArgsBytes;
  K.ContextBytes = Record->ContextBytes;
  K.LocalBytes = Record->LocalBytes;
  std::copy(std::begin(Record->LocalSize), std::end(Record->LocalSize),
            K.LocalSize.begin());
  K.Lanes = Record->Lanes;
  K.StackBytes = Record->StackBytes;
  for (uint32_t N = 0; N != Record->NumArgs; ++N) {
    const auto Arg = load<VxKernelArg>(
        Record->Args + N * static_cast<uint32_t>(sizeof(VxKernelArg)));
    auto ArgName = Arg ? loadString(Arg->Name) : std::nullopt;
    if (!ArgName)
      return Where +
             fmt::format("argument {} of '{}' is not in the image", N, K.Name);
    if (Arg->Kind > VX_ARG_FLOAT ||
        uint64_t{Arg->Offset} + Arg->Size > Record->ArgsBytes)
      return Where + fmt::format("argument {} of '{}' is malformed", N, K.Name);
    K.Args.push_back({std::move(*ArgName), Arg->Kind, Arg->Offset, Arg->Size});
  }
  Result->Kernels.push_back(std::move(K));
  return {};
}

std::string ImageParser::readVariables() {
  const auto [Lo, Hi] = VariableTable;
  if (Hi < Lo || VariableTable.bytes() % sizeof(VxVariables) != 0)
    return fmt::format("table of variables of {} bytes, expected a multiple of "
                       "{}",
                       VariableTable.bytes(), sizeof(VxVariables));
  for (uint32_t At = Lo; At != Hi; At += sizeof(VxVariables))
    if (std::string Wrong = readVariables(At); !Wrong.empty())
      return Wrong;
  return {};
}

std::string ImageParser::readVariables(uint32_t Address) {
  const std::string Where =
      fmt::format("table of variables at 0x{:08x}: ", Address);
  const auto Record = load<VxVariables>(Address);
  if (!Record)
    return Where + "not in initialised memory";
  const auto Owner =
      std::ranges::find(Result->Kernels, Record->Entry, &Kernel::Entry);
  if (Owner == Result->Kernels.end())
    return Where + fmt::format("no kernel begins at 0x{:08x}", Record->Entry);
  const auto IsInImage = [&](uint32_t Bytes, uint32_t At) {
    return Result->bytesAt(At, Bytes).size() == Bytes;
  };
  const uint64_t TableBytes = uint64_t{Record->NumPointers} * sizeof(uint32_t);
  if (Record->ContentsBytes > Record->Bytes || TableBytes > UINT32_MAX ||
      !std::has_single_bit(Record->Alignment) ||
      !IsInImage(Record->ContentsBytes, Record->Contents) ||
      !IsInImage(static_cast<uint32_t>(TableBytes), Record->Pointers))
    return Where + "malformed";
  // Kernels share no table of pointers.
  PointerBytes += TableBytes;
  if (PointerBytes > File.size())
    return Where + "more pointers than fit in the file";
  for (uint32_t N = 0; N != Record->NumPointers; ++N) {
    const auto Offset =
        load<uint32_t>(Record->Pointers + N * uint32_t{sizeof(uint32_t)});
    if (uint64_t{*Offset} + sizeof(uint32_t) > Record->ContentsBytes)
      return Where + fmt::format("pointer {} is outside the variables", N);
  }
  Owner->Variables = {Record->Bytes,    Record->Alignment,
                      Record->Contents, Record->ContentsBytes,
                      Record->Pointers, Record->NumPointers};
  return {};
}

Expected<std::shared_ptr<const Image>> ImageParser::parse() {
  for (auto Step : {&ImageParser::readHeader, &ImageParser::readSegments,
                    &ImageParser::readSections})
    if (std::string Wrong = (this->*Step)(); !Wrong.empty())
      return Error{Result->Name, std::move(Wrong)};
  return std::shared_ptr<const Image>(Result);
}

} // namespace vorion::isasim
