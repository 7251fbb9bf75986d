#include "vorion/isasim/Image.h"

#include "mem/ElfReader.h"
#include "mem/VxBinReader.h"

#include <algorithm>
#include <fmt/format.h>

namespace vorion::isasim {

const Kernel *Image::findKernel(std::string_view KernelName) const {
  const auto Found =
      std::find_if(Kernels.begin(), Kernels.end(),
                   [&](const Kernel &K) { return K.Name == KernelName; });
  return Found == Kernels.end() ? nullptr : &*Found;
}

Expected<Success> Image::checkLanes(uint32_t Lanes, std::string_view Of) const {
  for (const Kernel &K : Kernels)
    if (K.Lanes != 0 && K.Lanes != Lanes && (Of.empty() || K.Name == Of))
      return Error{Name,
                   fmt::format("kernel '{}' was compiled for warps of {} "
                               "lanes, expected {} as in the machine (the "
                               "compiler reads VORION_SET and VORION_CONFIG)",
                               K.Name, K.Lanes, Lanes)};
  return Success{};
}

std::optional<uint32_t> Image::findSymbol(std::string_view SymbolName) const {
  for (const Symbol &S : Symbols)
    if (S.Name == SymbolName)
      return S.Address;
  return std::nullopt;
}

std::string Image::symbolize(uint32_t Address) const {
  // The nearest function at or below; sizes are often missing in assembly.
  const Symbol *Best = nullptr, *Number = nullptr;
  for (const Symbol &S : Symbols) {
    if (S.Address > Address)
      break;
    if (S.IsAbsolute) {
      Number = S.Address == Address ? &S : Number;
      continue;
    }
    const bool Covers = S.Size == 0 || Address - S.Address < S.Size;
    if (Covers && (!Best || S.Address > Best->Address ||
                   (S.IsFunction && !Best->IsFunction)))
      Best = &S;
  }
  if (!Best)
    return Number ? Number->Name : "";
  const uint32_t Offset = Address - Best->Address;
  return Offset ? fmt::format("{}+0x{:x}", Best->Name, Offset) : Best->Name;
}

const Image::Segment *Image::segmentAt(uint32_t Address) const {
  const auto After = std::upper_bound(
      Segments.begin(), Segments.end(), Address,
      [](uint32_t A, const Segment &S) { return A < S.Address; });
  if (After == Segments.begin())
    return nullptr;
  const Segment &S = *std::prev(After);
  return Address - S.Address < S.MemBytes ? &S : nullptr;
}

std::span<const std::byte> Image::bytesAt(uint32_t Address,
                                          uint32_t Bytes) const {
  const Segment *S = segmentAt(Address);
  const uint32_t Within = S ? Address - S->Address : 0;
  if (!S || Within > S->Bytes.size() || Bytes > S->Bytes.size() - Within)
    return {};
  return std::span(S->Bytes).subspan(Within, Bytes);
}

Expected<std::shared_ptr<const Image>>
Image::parse(std::span<const std::byte> Elf, std::string Name) {
  // The only format without a mark of its own goes by its name.
  if (Name.ends_with(".vxbin"))
    return parseVxBin(Elf, std::move(Name));
  ImageParser Parser(Elf, std::move(Name));
  return Parser.parse();
}

std::shared_ptr<const Image> Image::raw(Segment Only, std::string Name) {
  auto Result = std::make_shared<Image>();
  Result->Name = std::move(Name);
  Result->Entry = Only.Address;
  Result->Segments.push_back(std::move(Only));
  return Result;
}

} // namespace vorion::isasim
