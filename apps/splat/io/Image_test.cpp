#include "io/Exr.h"
#include "io/Image.h"
#include "io/Npz.h"
#include "io/TestFiles.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <png.h>
#include <span>

using namespace vorion;
using namespace vorion::splat;

namespace {

/// \p Values in the precision that pictures are read in.
std::vector<double> exact(const std::vector<float> &Values) {
  return {Values.begin(), Values.end()};
}

Image sample() {
  Image I;
  I.Width = 3;
  I.Height = 2;
  for (int K = 0; K < 18; ++K)
    I.Render.push_back(static_cast<float>(K) * 0.1F - 0.3F);
  for (int K = 0; K < 6; ++K)
    I.Alpha.push_back(static_cast<float>(K) / 7);
  return I;
}

TEST(Image, PfmRoundTripsUnclamped) {
  const TestFolder Folder;
  ASSERT_TRUE(writeImage(Folder.path("i.pfm"), sample()));
  const auto I = readImage(Folder.path("i.pfm"));
  ASSERT_TRUE(I) << I.error().What;
  EXPECT_EQ(I->Width, 3);
  EXPECT_EQ(I->Height, 2);
  EXPECT_EQ(I->Render, exact(sample().Render));
  // The format's first row in the file is the bottom one.
  float First;
  std::memcpy(&First, Folder.read("i.pfm").data() + 12, sizeof(First));
  EXPECT_EQ(First, sample().Render[9]);
}

TEST(Image, NpzRoundTripsWithAlpha) {
  const TestFolder Folder;
  ASSERT_TRUE(writeImage(Folder.path("i.npz"), sample()));
  const auto I = readImage(Folder.path("i.npz"));
  ASSERT_TRUE(I) << I.error().What;
  EXPECT_EQ(I->Render, exact(sample().Render));
  EXPECT_EQ(I->Alpha, exact(sample().Alpha));
}

TEST(Image, NpzOfDoublesIsNotRounded) {
  const TestFolder Folder;
  const std::vector<double> Render{0.1, 0.2, 0.3}, Alpha{1.0 / 3};
  ASSERT_TRUE(writeNpz(Folder.path("i.npz"),
                       {{"render", NpyArray::of({1, 1, 3}, Render)},
                        {"alpha", NpyArray::of({1, 1}, Alpha)}}));
  const auto I = readImage(Folder.path("i.npz"));
  ASSERT_TRUE(I) << I.error().What;
  EXPECT_EQ(I->Render, Render);
  EXPECT_EQ(I->Alpha, Alpha);
}

/// A picture that is compressed in several strips.
Image large() {
  Image I;
  I.Width = 301;
  I.Height = 700;
  for (std::size_t K = 0; K < 3 * I.pixels(); ++K)
    I.Render.push_back(static_cast<float>(K * K % 1009) / 1000);
  return I;
}

TEST(Image, PngHoldsClampedBytes) {
  const TestFolder Folder;
  for (const Image &I : {sample(), large()}) {
    ASSERT_TRUE(writeImage(Folder.path("i.png"), I));
    png_image Png{};
    Png.version = PNG_IMAGE_VERSION;
    ASSERT_TRUE(
        png_image_begin_read_from_file(&Png, Folder.path("i.png").c_str()));
    EXPECT_EQ(Png.width, static_cast<unsigned>(I.Width));
    EXPECT_EQ(Png.height, static_cast<unsigned>(I.Height));
    Png.format = PNG_FORMAT_RGB;
    std::vector<unsigned char> Bytes(PNG_IMAGE_SIZE(Png)), Wanted(Bytes.size());
    ASSERT_TRUE(png_image_finish_read(&Png, nullptr, Bytes.data(), 0, nullptr))
        << Png.message;
    std::ranges::transform(I.Render, Wanted.begin(), toByte);
    EXPECT_EQ(Bytes, Wanted);
  }
}

/// \p Values as a file of 8 bits has them.
std::vector<double> inBytes(const std::vector<float> &Values) {
  std::vector<double> Bytes;
  for (const float V : Values)
    Bytes.push_back(toByte(V) / 255.0);
  return Bytes;
}

TEST(Image, FilesOf8BitsAreReadAsFractions) {
  const TestFolder Folder;
  for (const char *Name : {"i.png", "i.webp"}) {
    ASSERT_TRUE(writeImage(Folder.path(Name), sample()));
    const auto I = readImage(Folder.path(Name));
    ASSERT_TRUE(I) << I.error().What;
    EXPECT_TRUE(I->IsEightBit);
    EXPECT_EQ(I->Width, 3);
    EXPECT_EQ(I->Render, inBytes(sample().Render)) << Name;
    EXPECT_TRUE(I->Alpha.empty());
  }
  ASSERT_TRUE(writeImage(Folder.path("i.JPG"), sample()).error().Code ==
              ExitCode::Usage);
  ASSERT_TRUE(writeImage(Folder.path("i.jpg"), sample(), {.Quality = 100}));
  const auto Jpeg = readImage(Folder.path("i.jpg"));
  ASSERT_TRUE(Jpeg) << Jpeg.error().What;
  for (std::size_t K = 0; K < Jpeg->Render.size(); ++K)
    EXPECT_NEAR(Jpeg->Render[K], inBytes(sample().Render)[K], 0.02) << K;
}

TEST(Image, ExrRoundTripsUnclamped) {
  const TestFolder Folder;
  Image In = sample();
  In.Render[4] = 1e6F;
  ASSERT_TRUE(writeImage(Folder.path("i.exr"), In));
  const auto I = readImage(Folder.path("i.exr"));
  ASSERT_TRUE(I) << I.error().What;
  EXPECT_FALSE(I->IsEightBit);
  EXPECT_EQ(I->Render, exact(In.Render));
  EXPECT_EQ(I->Alpha, exact(In.Alpha));
  In.Alpha.clear();
  ASSERT_TRUE(
      writeImage(Folder.path("h.exr"), In, {.Quality = {}, .Half = true}));
  const auto H = readImage(Folder.path("h.exr"));
  ASSERT_TRUE(H) << H.error().What;
  EXPECT_TRUE(H->Alpha.empty());
  EXPECT_EQ(H->Render[4], std::numeric_limits<double>::infinity());
  for (std::size_t K = 5; K < H->Render.size(); ++K)
    EXPECT_NEAR(H->Render[K], In.Render[K], 5e-4) << K;
}

TEST(Image, TruncatedExrIsAnError) {
  const TestFolder Folder;
  ASSERT_TRUE(writeImage(Folder.path("i.exr"), sample()));
  const std::string File = Folder.read("i.exr");
  for (std::size_t Size = 0; Size < File.size(); ++Size) {
    const auto I =
        decodeExr("t.exr", std::as_bytes(std::span(File).first(Size)));
    ASSERT_FALSE(I) << Size;
    EXPECT_EQ(I.error().What.find('\n'), std::string::npos);
  }
}

TEST(Image, BytesAreRoundedAndNanIsBlack) {
  EXPECT_EQ(toByte(0), 0);
  EXPECT_EQ(toByte(-1), 0);
  EXPECT_EQ(toByte(1), 255);
  EXPECT_EQ(toByte(7), 255);
  EXPECT_EQ(toByte(0.5F), 128);
  EXPECT_EQ(toByte(std::nanf("")), 0);
  for (int Byte = 0; Byte < 255; ++Byte) {
    const float Tie = (static_cast<float>(Byte) + 0.5F) / 255;
    for (const float V :
         {std::nextafter(Tie, 0.0F), Tie, std::nextafter(Tie, 1.0F)})
      EXPECT_EQ(toByte(V), std::lround(V * 255)) << V;
  }
}

TEST(Image, UnknownEndingsAndUnwritablePathsAreErrors) {
  const TestFolder Folder;
  const auto Ending = writeImage(Folder.path("i.gif"), sample());
  ASSERT_FALSE(Ending);
  EXPECT_EQ(Ending.error().Code, ExitCode::Usage);
  for (const char *Name : {"no/i.png", "no/i.pfm", "no/i.npz"}) {
    const auto W = writeImage(Folder.path(Name), sample());
    ASSERT_FALSE(W);
    EXPECT_EQ(W.error().Code, ExitCode::InputFile);
  }
  EXPECT_FALSE(readImage(Folder.path("i.png")));
}

TEST(Image, DepthsAreWrittenWithAndWithoutAlpha) {
  const TestFolder Folder;
  const DepthMap D{3, 2, {1, 2, 3, 4, 5, 6}, sample().Alpha};
  ASSERT_TRUE(writeDepth(Folder.path("d.npz"), D));
  const auto Arrays = readNpz(Folder.path("d.npz"));
  ASSERT_TRUE(Arrays) << Arrays.error().What;
  EXPECT_EQ(Arrays->at("depth").Shape, (std::vector<std::size_t>{2, 3}));
  EXPECT_EQ(Arrays->at("depth").toDoubles(), exact(D.Depth));
  EXPECT_EQ(Arrays->at("alpha").toDoubles(), exact(D.Alpha));

  ASSERT_TRUE(writeDepth(Folder.path("d.pfm"), D));
  const std::string File = Folder.read("d.pfm");
  ASSERT_EQ(File.size(), 12 + 6 * sizeof(float));
  EXPECT_EQ(File.substr(0, 12), "Pf\n3 2\n-1.0\n");

  ASSERT_TRUE(writeDepth(Folder.path("d.exr"), D));
  const auto Grey = readImage(Folder.path("d.exr"));
  ASSERT_TRUE(Grey) << Grey.error().What;
  for (std::size_t P = 0; P < D.Depth.size(); ++P) {
    EXPECT_EQ(Grey->Render[3 * P], D.Depth[P]);
    EXPECT_EQ(Grey->Alpha[P], D.Alpha[P]);
  }
  EXPECT_FALSE(writeDepth(Folder.path("d.png"), D));
}

TEST(Image, TruncatedPfmIsAnError) {
  const TestFolder Folder;
  ASSERT_TRUE(writeImage(Folder.path("i.pfm"), sample()));
  const std::string File = Folder.read("i.pfm");
  for (std::size_t Size = 0; Size < File.size(); ++Size)
    EXPECT_FALSE(readImage(Folder.write("t.pfm", File.substr(0, Size))));
  EXPECT_FALSE(readImage(Folder.write("t.pfm", "PF\n99999 99999\n-1\n")));
  EXPECT_FALSE(readImage(Folder.write("t.pfm", "PF\n-1 -1\n-1\n")));
}

} // namespace
