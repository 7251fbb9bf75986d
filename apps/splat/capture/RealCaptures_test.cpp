// Captures that others made: what is known of them.
#include "capture/Capture.h"
#include "capture/Photo.h"
#include "vorion/support/File.h"

#include <filesystem>
#include <gtest/gtest.h>

using namespace vorion;
using namespace vorion::splat;

namespace {

const std::string Folder = "../shared/data/captures/";

struct RealCapture {
  const char *Name;
  CaptureFormat Format;
  std::size_t Views, HeldOut, Points;
  int Width;
};

class RealCaptures : public ::testing::TestWithParam<RealCapture> {};

TEST_P(RealCaptures, AreReadWhole) {
  const RealCapture &R = GetParam();
  if (!std::filesystem::exists(Folder + R.Name))
    GTEST_SKIP() << "no " << Folder << R.Name;
  const auto C = readCapture(Folder + R.Name);
  ASSERT_TRUE(C) << C.error().Where << ": " << C.error().What;
  EXPECT_EQ(C->Format, R.Format);
  EXPECT_EQ(C->Views.size(), R.Views);
  EXPECT_EQ(C->heldOut(), R.HeldOut);
  EXPECT_EQ(C->Points.size(), R.Points);
  EXPECT_GT(cameraRing(*C).Radius, 0);
  const CaptureView &V = C->Views[1];
  EXPECT_EQ(V.Pose.Width, R.Width);
  const auto File = readFile(V.Picture);
  ASSERT_TRUE(File);
  const auto P = decodePhoto(V.Picture, *File);
  ASSERT_TRUE(P) << P.error().What;
  EXPECT_EQ(P->pixels(), std::size_t(V.Pose.Width) * V.Pose.Height);
}

INSTANTIATE_TEST_SUITE_P(
    All, RealCaptures,
    ::testing::Values(RealCapture{"carving_colmap", CaptureFormat::ColmapBinary,
                                  23, 3, 1443, 1000},
                      RealCapture{"desk_colmap", CaptureFormat::ColmapBinary,
                                  29, 4, 7562, 1906},
                      RealCapture{"chair_synthetic",
                                  CaptureFormat::NerfSynthetic, 125, 25, 0,
                                  800}),
    [](const auto &Info) { return std::string(Info.param.Name); });

} // namespace
