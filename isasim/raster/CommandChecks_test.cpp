// What a command is refused for, and with which status.
#include "raster/RasterTest.h"
#include "raster/UnitTables.h"

#include <cmath>
#include <cstring>

namespace vorion::raster {
namespace {

using RasterizerTest = RasterTest;

TEST_F(RasterizerTest, StatusCodesOfTheBank) {
  struct Case {
    Csr Register;
    uint32_t Value;
    uint32_t Status;
  };
  const auto F = [](float X) { return std::bit_cast<uint32_t>(X); };
  const uint32_t End = TestMemory::Base + (8 << 20);
  const Case Cases[] = {
      {Csr::Mode, 1 << 13, VR_BAD_MODE},
      {Csr::Options, OptionsExp.put(VR_EXP_TABLE64), VR_OK},
      // Reserved: the units were removed.
      {Csr::Options, OptionsExp.put(7), VR_BAD_MODE},
      {Csr::Options, OptionsExp.put(8), VR_BAD_MODE},
      {Csr::Options, OptionsExp.put(15), VR_BAD_MODE},
      {Csr::Options, OptionsBlend.put(BlendUnitCount), VR_BAD_MODE},
      {Csr::Options, 0x80000000, VR_BAD_MODE},
      {Csr::Ztile, 0x00010001, VR_BAD_MODE},
      {Csr::Ztile, 0x00000001, VR_BAD_MODE},
      {Csr::Ztile, 0x00040003, VR_OK},
      {Csr::TileShape, 0x00400000, VR_BAD_SHAPE},
      {Csr::TileShape, 0x00000040, VR_BAD_SHAPE},
      {Csr::TileShape, 0x00400041, VR_BAD_SHAPE},
      {Csr::TileShape, 0x00410040, VR_BAD_SHAPE},
      {Csr::TileShape, 0x00010001, VR_OK},
      {Csr::TileOrigin, 0xffffffff, VR_OK},
      {Csr::Cutoff, F(1.0F), VR_BAD_CUTOFF},
      {Csr::Cutoff, F(-1e-4F), VR_BAD_CUTOFF},
      {Csr::Cutoff, F(NotANumber), VR_BAD_CUTOFF},
      {Csr::Cutoff, F(Inf), VR_BAD_CUTOFF},
      {Csr::Cutoff, F(std::nextafter(1.0F, 0.0F)), VR_OK},
      {Csr::Count, VR_MAX_COUNT + 1, VR_BAD_COUNT},
      {Csr::Count, VR_MAX_COUNT, VR_UNMAPPED}, // beyond this memory
      {Csr::Gaussians, Records + 8, VR_MISALIGNED},
      {Csr::List, List + 2, VR_MISALIGNED},
      {Csr::Output, Pixels + 4, VR_MISALIGNED},
      {Csr::OutputPitch, Pitch + 8, VR_MISALIGNED},
      {Csr::Gaussians, 0, VR_UNMAPPED},
      {Csr::Gaussians, 0xffff0000, VR_UNMAPPED}, // local memory
      {Csr::Gaussians, End - 32, VR_UNMAPPED},
      {Csr::Gaussians, End - 48, VR_OK},
      {Csr::List, 0xfffffffc, VR_UNMAPPED},
      {Csr::List, End, VR_UNMAPPED},
      {Csr::Output, 0xffff0000, VR_UNMAPPED},
      {Csr::Output, End - 63 * Pitch - 64 * 16, VR_OK},
      {Csr::Output, End - 63 * Pitch - 63 * 16, VR_UNMAPPED},
      {Csr::OutputPitch, 0xfffffff0, VR_UNMAPPED}, // must not wrap around
      {Csr::OutputPitch, 0x80000000, VR_UNMAPPED},
  };
  for (const Case &Wrong : Cases) {
    const Gaussian G = flatGaussian(8, 8, 4, 4, 0.5F);
    configure(only(G));
    set(Wrong.Register, Wrong.Value);
    EXPECT_EQ(start(), Wrong.Status)
        << findCsr(static_cast<unsigned>(Wrong.Register))->Name << ' '
        << Wrong.Value;
  }
  EXPECT_EQ(Agent.counters().Commands, std::size(Cases));
}

TEST_F(RasterizerTest, FirstCheckDecides) {
  // Everything is wrong; repaired in the documented order.
  configure({});
  set(Csr::Mode, 1U << 13);
  set(Csr::TileShape, 0U);
  set(Csr::Cutoff, 1.0F);
  set(Csr::Count, 0xffffffffU);
  set(Csr::List, 0xffff0001U);
  EXPECT_EQ(start(), VR_BAD_MODE);
  set(Csr::Mode, 0U);
  EXPECT_EQ(start(), VR_BAD_SHAPE);
  set(Csr::TileShape, 0x400040U);
  EXPECT_EQ(start(), VR_BAD_CUTOFF);
  set(Csr::Cutoff, 0.0F);
  EXPECT_EQ(start(), VR_BAD_COUNT);
  set(Csr::Count, 1U);
  EXPECT_EQ(start(), VR_MISALIGNED);
  set(Csr::List, 0xffff0000U);
  EXPECT_EQ(start(), VR_UNMAPPED);
}

TEST_F(RasterizerTest, ListEntryOutOfRangeIsUnmapped) {
  for (const uint32_t Number : {0xffffffffU, 0x05555556U, 200000U}) {
    const Gaussian Scene[] = {flatGaussian(8, 8, 4, 4, 0.5F),
                              flatGaussian(8, 8, 4, 4, 0.5F)};
    configure(Scene);
    Memory.put<uint32_t>(List + 4, std::span(&Number, 1));
    EXPECT_EQ(start(), VR_UNMAPPED) << Number;
  }
}

TEST_F(RasterizerTest, NanAnywhereInADescriptor) {
  for (unsigned Word = 0; Word != 12; ++Word) {
    Memory.put<float>(Pixels, std::vector<float>(64 * 64 * 4, 7.0F));
    Gaussian Scene[] = {flatGaussian(8, 8, 4, 4, 0.5F),
                        flatGaussian(8, 8, 4, 4, 0.5F)};
    std::memcpy(reinterpret_cast<char *>(&Scene[1]) + 4 * Word, &NotANumber, 4);
    configure(Scene);
    // The tag is no float.
    EXPECT_EQ(start(), Word == 11 ? VR_OK : VR_NAN) << Word;
    // A failed command writes no pixel.
    if (Word != 11) {
      EXPECT_EQ(pixels()[0].R, 7.0F);
    }
  }
}

TEST_F(RasterizerTest, InfinityIsNotANan) {
  const Gaussian G{{Inf, 3}, {1, 0, 1}, 0.5F, {1, 1, 1}, {Inf, Inf}, 0};
  render(only(G));
  EXPECT_EQ(Agent.counters().Fragments, 4096U);
  EXPECT_EQ(Agent.counters().Blends, 0U);
}

} // namespace
} // namespace vorion::raster
