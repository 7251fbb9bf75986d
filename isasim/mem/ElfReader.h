/// Takes a 32-bit RISC-V ELF executable apart (System V gABI; RISC-V ELF
/// psABI). Every offset and size of the file is checked before it is used.
#pragma once

#include "vorion/isasim/Image.h"

#include <elf.h>

namespace vorion::isasim {

class ImageParser {
public:
  ImageParser(std::span<const std::byte> Elf, std::string Name)
      : File(Elf), Result(std::make_shared<Image>()) {
    Result->Name = std::move(Name);
    Result->File.assign(Elf.begin(), Elf.end());
  }

  Expected<std::shared_ptr<const Image>> parse();

private:
  struct Range {
    uint32_t Lo = 0, Hi = 0;
    uint32_t bytes() const { return Hi - Lo; }
    bool contains(uint32_t Address) const {
      return Address >= Lo && Address < Hi;
    }
  };

  // Each step returns what is wrong, or an empty string.
  std::string readHeader();
  std::string readSegments();
  std::string checkSegments();
  std::string readSections();
  std::string readSymbols(const Elf32_Shdr &Table);
  /// What \p Name bounds if no section of that name did.
  void findBySymbols(const std::string &Name, Range &Table) const;
  std::string readKernels();
  std::string readKernel(uint32_t Address);
  std::string readVariables();
  std::string readVariables(uint32_t Address);
  std::string readWarps();
  std::string readAtomicPlaces(const Elf32_Shdr &Table);
  /// Whether the code uses what a core has once: its Raster Agent, or barriers
  /// between warps that count them.
  bool needsCoreAlone() const;

  /// The part of the file, or nothing if it is not all there.
  std::optional<std::span<const std::byte>> part(uint64_t Offset,
                                                 uint64_t Bytes) const;
  template <typename T> std::optional<T> get(uint64_t Offset) const;
  template <typename T> std::optional<T> load(uint32_t Address) const;
  /// Whether names of so many bytes more are not too much for the file.
  bool countName(size_t Bytes);
  /// The NUL-terminated string in the image at \p Address.
  std::optional<std::string> loadString(uint32_t Address);
  bool isCode(uint32_t Address) const;

  std::span<const std::byte> File;
  std::shared_ptr<Image> Result;
  Elf32_Ehdr Header{};
  Range KernelTable, VariableTable, WarpsCode, StaticObjectsCode;
  size_t NameBytes = 0;      ///< of names read so far
  size_t NumArgs = 0;        ///< of kernels read so far
  uint64_t PointerBytes = 0; ///< of tables of variables read so far
};

} // namespace vorion::isasim
