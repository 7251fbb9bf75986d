#include "observe/check/Buffers.h"
#include "vorion/support/Letters.h"

#include <fmt/format.h>

namespace vorion::isasim {

namespace {

std::string named(const Buffers::Buffer &B) {
  return fmt::format("{} ({} at 0x{:08x})", B.Name, counted(B.Bytes, "byte"),
                     B.Address);
}

} // namespace

void Buffers::rename(uint32_t Address, std::string Name) {
  if (const Buffer *B = find(Address, 1))
    ByAddress[B->Address].Name = std::move(Name);
}

const Buffers::Buffer *Buffers::find(uint32_t Address, uint64_t Bytes) const {
  auto After = ByAddress.upper_bound(Address);
  if (After == ByAddress.begin())
    return nullptr;
  const Buffer &B = std::prev(After)->second;
  return Address + Bytes <= B.end() ? &B : nullptr;
}

std::string Buffers::describe(uint32_t Address) const {
  const auto After = ByAddress.upper_bound(Address);
  const Buffer *Before =
      After == ByAddress.begin() ? nullptr : &std::prev(After)->second;
  const Buffer *Next = After == ByAddress.end() ? nullptr : &After->second;
  if (Before && Address < Before->end())
    return fmt::format("{} into {}", counted(Address - Before->Address, "byte"),
                       named(*Before));
  const uint64_t Past = Before ? Address - Before->end() : UINT64_MAX;
  const uint64_t Ahead = Next ? Next->Address - Address : UINT64_MAX;
  if (Before && Past <= Ahead)
    return fmt::format("{} past the end of {}", counted(Past, "byte"),
                       named(*Before));
  if (Next)
    return fmt::format("{} before {}", counted(Ahead, "byte"), named(*Next));
  return "unallocated memory";
}

} // namespace vorion::isasim
