#include "capture/Photo.h"

#include "capture/CaptureTest.h"

#include <algorithm>
#include <random>

using namespace vorion;
using namespace vorion::splat;
using namespace vorion::splat::testing;

namespace {

Bytes bytesOf(const std::string &Text) {
  return std::as_bytes(std::span(Text));
}

std::string noise(std::size_t Size) {
  std::mt19937 Random(3);
  std::string Text(Size, '\0');
  std::ranges::generate(Text, [&] { return static_cast<char>(Random()); });
  return Text;
}

TEST(Photo, LosslessFormatsGiveTheirBytes) {
  const std::string Rgba = noise(4 * 5 * 3);
  for (const std::string &File : {pngOf(5, 3, Rgba), webpOf(5, 3, Rgba)}) {
    const auto P = decodePhoto("file", bytesOf(File));
    ASSERT_TRUE(P) << P.error().What;
    EXPECT_EQ(P->Width, 5U);
    EXPECT_EQ(P->Height, 3U);
    for (std::size_t I = 0; I < 15; ++I) {
      EXPECT_EQ(P->at(I, 3), static_cast<uint8_t>(Rgba[4 * I + 3]));
      // WebP leaves the colour of fully transparent pixels open.
      if (P->at(I, 3) != 0) {
        EXPECT_EQ(P->at(I, 1), static_cast<uint8_t>(Rgba[4 * I + 1]));
      }
    }
  }
}

TEST(Photo, JpegIsOpaqueAndNear) {
  const std::string Rgba(std::size_t(4) * 16 * 8, '\x60');
  const std::string File = jpegOf(16, 8, Rgba);
  const auto P = decodePhoto("file", bytesOf(File));
  ASSERT_TRUE(P) << P.error().What;
  EXPECT_EQ(P->pixels(), 128U);
  EXPECT_EQ(P->at(77, 3), 255U);
  EXPECT_NEAR(P->at(77, 0), 0x60, 1);
}

TEST(Photo, DamageIsReadOrRefused) {
  const std::string Rgba = noise(4 * 5 * 3);
  const std::string Files[] = {pngOf(5, 3, Rgba), webpOf(5, 3, Rgba),
                               jpegOf(5, 3, Rgba)};
  for (const std::string &File : Files) {
    unsigned Refused = 0;
    for (std::size_t At = 0; At < File.size(); ++At) {
      const std::string Cut = File.substr(0, At);
      Refused += !decodePhoto("file", bytesOf(Cut));
      std::string Changed = File;
      Changed[At] = static_cast<char>(~Changed[At]);
      const auto P = decodePhoto("file", bytesOf(Changed));
      if (P) {
        EXPECT_EQ(P->Rgba.size(), 4 * P->pixels());
      } else {
        EXPECT_TRUE(std::ranges::all_of(P.error().What, [](char C) {
          return C >= ' ' && C <= '~';
        })) << P.error().What;
      }
    }
    EXPECT_GT(Refused, File.size() / 2);
  }
}

TEST(Photo, HugeClaimsAreRefused) {
  std::string File = pngOf(4, 4, std::string(64, '\0'));
  EXPECT_TRUE(photoSize("file", bytesOf(File)));
  const std::string Wide = webpOf(4096, 4096, std::string(4U << 24, '\xff'));
  const auto P = decodePhoto("file", bytesOf(Wide));
  ASSERT_FALSE(P);
  EXPECT_NE(P.error().What.find("bytes unpacked"), std::string::npos);
}

/// A 2x2 JPEG whose EXIF data have this orientation, in either byte order.
std::string orientedJpeg(int Orientation, bool IsBig) {
  const char Value = static_cast<char>(Orientation);
  std::string Exif =
      IsBig
          ? std::string("MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0", 19) +
                Value + std::string(6, '\0')
          : std::string("II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0", 18) +
                Value + std::string(7, '\0');
  Exif = std::string("Exif\0\0", 6) + Exif;
  std::string File = jpegOf(2, 2, std::string(16, '\x60'));
  return File.insert(2, std::string("\xff\xe1\0", 3) +
                            static_cast<char>(Exif.size() + 2) + Exif);
}

TEST(Photo, OrientationIsThatOfItsExifData) {
  for (int O = 1; O <= 8; ++O)
    for (const bool IsBig : {false, true})
      EXPECT_EQ(photoOrientation(bytesOf(orientedJpeg(O, IsBig))), O);
  EXPECT_EQ(photoOrientation(bytesOf(orientedJpeg(9, false))), 1);
  EXPECT_EQ(photoOrientation(bytesOf(jpegOf(2, 2, std::string(16, '\x60')))),
            1);
  const std::string Whole = orientedJpeg(6, true);
  for (std::size_t Size = 0; Size < Whole.size(); ++Size) {
    const int O = photoOrientation(bytesOf(Whole.substr(0, Size)));
    EXPECT_TRUE(O == 1 || O == 6) << Size;
  }
}

TEST(Photo, TurnedPicturesAreAsTheirOrientationSays) {
  // Stored in rows: 1 2 3, 4 5 6.
  Plane P;
  P.Width = 3;
  P.Height = 2;
  for (int V = 1; V <= 6; ++V)
    P.Rgba.insert(P.Rgba.end(), 4, std::byte(V));
  const std::vector<int> Seen[] = {{1, 2, 3, 4, 5, 6}, {3, 2, 1, 6, 5, 4},
                                   {6, 5, 4, 3, 2, 1}, {4, 5, 6, 1, 2, 3},
                                   {1, 4, 2, 5, 3, 6}, {4, 1, 5, 2, 6, 3},
                                   {6, 3, 5, 2, 4, 1}, {3, 6, 2, 5, 1, 4}};
  for (int O = 1; O <= 8; ++O) {
    const Plane T = turned(P, O);
    EXPECT_EQ(T.Width, O < 5 ? 3U : 2U);
    EXPECT_EQ(T.Height, O < 5 ? 2U : 3U);
    for (std::size_t I = 0; I < 6; ++I)
      EXPECT_EQ(static_cast<int>(T.at(I, 2)),
                Seen[static_cast<std::size_t>(O) - 1][I])
          << O << ' ' << I;
  }
}

TEST(Photo, ShrinkingAveragesAreas) {
  Plane P;
  P.Width = 4;
  P.Height = 2;
  for (const int V : {0, 10, 20, 30, 40, 50, 60, 70})
    for (int K = 0; K < 4; ++K)
      P.Rgba.push_back(std::byte(K == 3 ? 255 : V + K));
  const Photo Half = shrink(P, 2, 1, {});
  EXPECT_EQ(Half.Rgb, (std::vector<uint8_t>{25, 26, 27, 45, 46, 47}));
  // Three of four columns each: 0 10/3, 20/3 40/3, 50/3 30 in parts.
  const Photo Thirds = shrink(P, 3, 2, {});
  EXPECT_NEAR(Thirds.Rgb[0], 2.5, 0.5);  // (0 + 10/3) 3/4
  EXPECT_EQ(Thirds.Rgb[3], 15);          // (20/3 + 40/3) 3/4
  EXPECT_NEAR(Thirds.Rgb[6], 27.5, 0.5); // (20/3 + 30) 3/4
  const Photo Same = shrink(P, 4, 2, {});
  EXPECT_EQ(Same.Rgb[3], 10);
}

TEST(Photo, AlphaIsCompositedOnTheBackground) {
  Plane P;
  P.Width = P.Height = 1;
  P.Rgba = {std::byte(200), std::byte(100), std::byte(0), std::byte(51)};
  // A fifth of it and four of the background.
  EXPECT_EQ(shrink(P, 1, 1, {1, 0, 0.5F}).Rgb,
            (std::vector<uint8_t>{244, 20, 102}));
}

TEST(Photo, StretchedCamerasSeeTheSame) {
  Camera C;
  C.Width = 1000;
  C.Height = 661;
  C.Fx = 2000;
  C.Fy = 1990;
  C.Cx = 500;
  C.Cy = 330.5;
  const Camera R = stretched(C, shrunkSide(1000, 4), shrunkSide(661, 4));
  EXPECT_EQ(R.Width, 250);
  EXPECT_EQ(R.Height, 165);
  EXPECT_DOUBLE_EQ(R.Fx, 500);
  EXPECT_DOUBLE_EQ(R.Cy, 82.5);
  EXPECT_DOUBLE_EQ(R.Fy, 1990 * 165.0 / 661);
  EXPECT_EQ(shrunkSide(3, 8), 1);
}

} // namespace
