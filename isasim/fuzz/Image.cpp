#include "fuzz/Targets.h"

#include "testing/ElfBuilder.h"

namespace vorion::isasim::fuzz {

namespace {

/// Looks at all that an image has.
void use(const Image &I) {
  uint64_t Sum = I.entry();
  for (const Image::Segment &S : I.segments())
    Sum += I.bytesAt(S.Address, 4).size() + I.symbolize(S.Address).size();
  for (const Kernel &K : I.kernels())
    Sum += K.Name.size() + K.Args.size();
  Sum += I.findSymbol("tohost").value_or(0);
  [[maybe_unused]] const volatile uint64_t Keep = Sum;
}

} // namespace

void readImage(std::span<const std::byte> Bytes) {
  for (const char *Name : {"x.elf", "x.vxbin"})
    if (const auto I = Image::parse(Bytes, Name))
      use(**I);
}

std::vector<std::vector<std::byte>> imageSeeds() {
  using namespace testing;
  constexpr uint32_t Nop = 0x13;
  ElfOptions Plain;
  Plain.Segments = {{VX_IMAGE_BASE, PF_R | PF_X, {Nop, Nop}, 0},
                    {VX_IMAGE_BASE + 0x1000, PF_R | PF_W, {1, 2, 3}, 100}};
  Plain.Symbols = {{"_start", VX_IMAGE_BASE},
                   {"tohost", VX_IMAGE_BASE + 0x1000}};
  std::vector<std::vector<std::byte>> Seeds = {buildElf(Plain)};
  Plain.Flags = 0;
  Seeds.push_back(buildElf(Plain));
  // A kernel table: a record, an argument, names.
  constexpr uint32_t Table = VX_IMAGE_BASE + 0x1000;
  const uint32_t Args = Table + sizeof(VxKernel);
  const uint32_t Names = Args + sizeof(VxKernelArg);
  ElfOptions WithKernel = Plain;
  WithKernel.Segments[1] = {Table,
                            PF_R,
                            {Names, VX_IMAGE_BASE, Args, 1, 4, 0, 0, 0, 0, 0, 0,
                             0, Names, VX_ARG_GLOBAL, 0, 4, 0x006B6B6B},
                            0};
  WithKernel.Symbols = {
      {"__start_vorion_kernels", Table},
      {"__stop_vorion_kernels", Table + uint32_t{sizeof(VxKernel)}}};
  Seeds.push_back(buildElf(WithKernel));
  for (const size_t Part : {20U, 60U, 90U}) {
    std::vector<std::byte> Cut = Seeds.back();
    Cut.resize(Cut.size() * Part / 100);
    Seeds.push_back(std::move(Cut));
  }
  const uint64_t Range[2] = {VX_IMAGE_BASE, VX_IMAGE_BASE + 64};
  const auto Raw = std::as_bytes(std::span(Range));
  Seeds.emplace_back(Raw.begin(), Raw.end());
  return Seeds;
}

} // namespace vorion::isasim::fuzz
