/// Rasterizers and pixel units in a machine, which its cores and the host
/// command.

#include "machine/MachineTest.h"
#include "raster/RasterTables.h"

#include <cstddef>
#include <utility>

using namespace vorion;
using namespace vorion::isasim;
using namespace vorion::isasim::testing;

namespace {

/// As the host names a CSR.
unsigned number(raster::Csr C) { return static_cast<unsigned>(C); }

} // namespace

TEST(Machine, RasterCommandsRunAndAnswer) {
  // A tile of 4 x 2 pixels without Gaussians at Slots: black, T = 1.
  const auto M = machineFor(
      smallConfig(),
      {csrr(5, CSR_CORE_ID), bne(5, 0, 17 * 4), lui(10, Slots),
       csrw(raster::Csr::Output, 10), addi(11, 0, 64),
       csrw(raster::Csr::OutputPitch, 11), lui(12, 0x20000), addi(12, 12, 4),
       csrw(raster::Csr::TileShape, 12), csrw(raster::Csr::Start, 0),
       csrr(13, raster::Csr::Wait), lui(14, Counter), sw(13, 0, 14),
       // The second has no shape.
       csrw(raster::Csr::TileShape, 0), csrw(raster::Csr::Start, 0),
       csrr(13, raster::Csr::Wait), sw(13, 4, 14),
       csrr(13, raster::Csr::NCommands), encode(Op::VX_TMC, {.Rs1 = 0})});
  const RunResult R = M->run();
  ASSERT_EQ(R.End, Outcome::Done) << R.Report;
  EXPECT_EQ(wordAt(*M, Counter), raster::VR_OK);
  EXPECT_EQ(wordAt(*M, Counter + 4), raster::VR_BAD_SHAPE);
  EXPECT_EQ(R.Raster.Commands, 2U);
  for (uint32_t Row = 0; Row != 2; ++Row)
    for (uint32_t Column = 0; Column != 4; ++Column) {
      const uint32_t Pixel = Slots + Row * 64 + Column * 16;
      EXPECT_EQ(wordAt(*M, Pixel), 0U);
      EXPECT_EQ(wordAt(*M, Pixel + 12), 0x3F800000U);
    }
  // The counters go on, a run's own begin at 0.
  EXPECT_EQ(M->run().Raster.Commands, 2U);
  EXPECT_EQ(M->readRasterCsr(0, number(raster::Csr::NCommands)), 4U);
  EXPECT_EQ(M->readRasterCsr(1, number(raster::Csr::NCommands)), 0U);
}

TEST(Machine, HostDrivesTheRasterWindow) {
  const auto M = machineFor(smallConfig(), {0});
  EXPECT_TRUE(M->writeRasterCsr(7, number(raster::Csr::Output), Slots));
  EXPECT_TRUE(M->writeRasterCsr(7, number(raster::Csr::OutputPitch), 16));
  EXPECT_TRUE(M->writeRasterCsr(7, number(raster::Csr::TileShape), 0x00010001));
  EXPECT_TRUE(M->writeRasterCsr(7, number(raster::Csr::Start), 0));
  EXPECT_EQ(M->readRasterCsr(7, number(raster::Csr::Wait)), raster::VR_OK);
  EXPECT_EQ(wordAt(*M, Slots + 12), 0x3F800000U);
  EXPECT_EQ(M->readRasterCsr(7, number(raster::Csr::TileShape)), 0x00010001U);
  EXPECT_FALSE(M->writeRasterCsr(7, number(raster::Csr::Status), 0));
  EXPECT_FALSE(M->writeRasterCsr(8, number(raster::Csr::Mode), 0));
  EXPECT_FALSE(M->readRasterCsr(0, 0x300));
}

TEST(Machine, HandOversReachThePixelUnitOfTheCluster) {
  Config C = smallConfig();
  C.Clusters = 2;
  const auto M = machineFor(C, {encode(Op::VX_TMC, {.Rs1 = 0})});
  // Two pixels, two Gaussians of no box: all that is left of the second.
  constexpr uint32_t Record = Slots + 0x1000, Gaussians = Slots + 0x2000;
  const unsigned Last = C.cores() - 1;
  for (const auto &[R, Value] : {std::pair{raster::Csr::Gaussians, Gaussians},
                                 {raster::Csr::List, Gaussians + 0x100},
                                 {raster::Csr::Count, 2U},
                                 {raster::Csr::Output, Slots},
                                 {raster::Csr::OutputPitch, 32U},
                                 {raster::Csr::TileShape, 0x00010002U},
                                 {raster::Csr::TailCount, 1U},
                                 {raster::Csr::TailRecord, Record},
                                 {raster::Csr::Start, 0U}})
    EXPECT_TRUE(M->writeRasterCsr(Last, number(R), Value));
  EXPECT_EQ(M->readRasterCsr(Last, number(raster::Csr::Wait)), raster::VR_OK);
  EXPECT_EQ(M->readRasterCsr(Last, number(raster::Csr::NTails)), 1U);
  EXPECT_EQ(M->readRasterCsr(Last, number(raster::Csr::NTailPixels)), 2U);
  EXPECT_EQ(M->readRasterCsr(Last, number(raster::Csr::NTailVisits)), 2U);
  EXPECT_EQ(M->readRasterCsr(0, number(raster::Csr::NTails)), 0U);
  EXPECT_EQ(wordAt(*M, Record + offsetof(raster::Tail, Core)), Last);
}
