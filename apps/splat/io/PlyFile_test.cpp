#include "io/PlyFile.h"

#include <gtest/gtest.h>
#include <limits>

using namespace vorion;
using namespace vorion::splat;

namespace {

Bytes bytesOf(const std::string &Text) {
  return std::as_bytes(std::span(Text));
}

/// The error of reading \p File, as "place: what".
std::string errorOf(const std::string &File) {
  const auto Read = readPly("f", bytesOf(File));
  return Read ? "" : Read.error().Where + ": " + Read.error().What;
}

/// Number \p Number as the bytes of a big-endian file.
template <typename T> std::string big(T Number) {
  std::string Bytes(reinterpret_cast<const char *>(&Number), sizeof(T));
  return {Bytes.rbegin(), Bytes.rend()};
}

const std::string AllTypes = "element point 2\n"
                             "property char a\nproperty uint8 b\n"
                             "property short c\nproperty uint16 d\n"
                             "property int e\nproperty uint32 f\n"
                             "property float32 g\nproperty double h\n"
                             "end_header\n";

/// Row 1 of AllTypes, -1 and 200 to 0.1 in both precisions.
void expectAllTypes(const std::string &File) {
  const auto Read = readPly("f", bytesOf(File));
  ASSERT_TRUE(Read) << Read.error().Where << ": " << Read.error().What;
  const PlyElement &E = Read->header().Elements.at(0);
  const Bytes Row = Read->row(E, 1);
  const auto At = [&](const char *Name) { return E.find(Name)->Offset; };
  EXPECT_EQ(load<int8_t>(Row, At("a")), -1);
  EXPECT_EQ(load<uint8_t>(Row, At("b")), 200);
  EXPECT_EQ(load<int16_t>(Row, At("c")), -300);
  EXPECT_EQ(load<uint16_t>(Row, At("d")), 60000);
  EXPECT_EQ(load<int32_t>(Row, At("e")), -70000);
  EXPECT_EQ(load<uint32_t>(Row, At("f")), 4000000000U);
  EXPECT_EQ(load<float>(Row, At("g")), 0.1F);
  EXPECT_EQ(load<double>(Row, At("h")), 0.1);
}

TEST(PlyFile, TextHasEveryType) {
  expectAllTypes("ply\nformat ascii 1.0\n" + AllTypes +
                 "1 1 1 1 1 1 1 1\n"
                 "-1 +200 -300 60000 -70000 4000000000 0.1 1e-1\n");
}

TEST(PlyFile, BigEndianHasEveryType) {
  const auto Row = [](int8_t A, uint8_t B, int16_t C, uint16_t D, int32_t E,
                      uint32_t F, float G, double H) {
    return big(A) + big(B) + big(C) + big(D) + big(E) + big(F) + big(G) +
           big(H);
  };
  expectAllTypes("ply\nformat binary_big_endian 1.0\n" + AllTypes +
                 Row(1, 2, 3, 4, 5, 6, 7, 8) +
                 Row(-1, 200, -300, 60000, -70000, 4000000000U, 0.1F, 0.1));
}

TEST(PlyFile, TextMayBeBrokenAnywhereBetweenNumbers) {
  const std::string Header =
      "ply\r\nformat ascii 1.0\r\nelement vertex 2\r\nproperty float x\r\n"
      "property float y\r\nend_header\r\n";
  for (const char *Body : {"1 2\r\n3 4\r\n", "1\n2\n\n3\n4", "  1 2 3 4  "}) {
    const std::string File = Header + Body;
    const auto Read = readPly("f", bytesOf(File));
    ASSERT_TRUE(Read) << Read.error().What;
    const PlyElement &Vertex = Read->header().Elements.at(0);
    EXPECT_EQ(load<float>(Read->row(Vertex, 1), 4), 4);
  }
}

TEST(PlyFile, FloatsOfTextRoundOnceAndBeyondTheirRangeToZeroOrInfinity) {
  const std::string File =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float a\n"
      "property float b\nproperty float c\nproperty float d\nend_header\n"
      "16777217.0000001 1e-60 -1e60 nan\n";
  const auto Read = readPly("f", bytesOf(File));
  ASSERT_TRUE(Read) << Read.error().What;
  const Bytes Row = Read->row(Read->header().Elements[0], 0);
  EXPECT_EQ(load<float>(Row, 0), 16777218.0F); // 16777216 after two roundings
  EXPECT_EQ(load<float>(Row, 4), 0);
  EXPECT_EQ(load<float>(Row, 8), -std::numeric_limits<float>::infinity());
  EXPECT_NE(load<float>(Row, 12), load<float>(Row, 12));
}

TEST(PlyFile, ElementsWithListsArePassedOver) {
  const auto HeaderOf = [](const char *Format) {
    return std::string("ply\nformat ") + Format +
           " 1.0\nelement face 2\nproperty list uchar short corners\n"
           "property float weight\nelement vertex 1\nproperty float x\n"
           "end_header\n";
  };
  for (const std::string &File :
       {HeaderOf("ascii") + "3 0 1 2 0.5\n0 0.5\n7.5\n",
        HeaderOf("binary_big_endian") + big(uint8_t(3)) + big(int16_t(0)) +
            big(int16_t(1)) + big(int16_t(2)) + big(0.5F) + big(uint8_t(0)) +
            big(0.5F) + big(7.5F)}) {
    const auto Read = readPly("f", bytesOf(File));
    ASSERT_TRUE(Read) << Read.error().What;
    const PlyElement *Vertex = Read->header().find("vertex");
    EXPECT_EQ(load<float>(Read->row(*Vertex, 0), 0), 7.5F);
    for (std::size_t Size = 0; Size + 4 < File.size(); ++Size)
      EXPECT_NE(errorOf(File.substr(0, Size)), "") << Size;
  }
}

TEST(PlyFile, ErrorsNameTheLine) {
  const std::string Header = "ply\nformat ascii 1.0\nelement vertex 2\n"
                             "property float x\nproperty uchar red\n"
                             "end_header\n";
  EXPECT_EQ(errorOf(Header + "1 2\n1 2\n"), "");
  EXPECT_EQ(errorOf(Header + "1 2\nx 2\n"),
            "f:8: `x` in row 1 of element vertex, expected property x, the "
            "type in the header");
  EXPECT_EQ(errorOf(Header + "1 256\n1 2\n").substr(0, 11), "f:7: `256` ");
  EXPECT_EQ(errorOf(Header + "1 -1\n1 2\n").substr(0, 10), "f:7: `-1` ");
  EXPECT_EQ(errorOf(Header + "1 2\n1\n"),
            "f:9: truncated in row 1 of element vertex, expected 2 rows");
  EXPECT_EQ(errorOf(Header + "1 2\n1 2\n\n5"),
            "f:10: `5` after the last element, expected the end of the file");
  EXPECT_EQ(errorOf("ply\nformat ascii 2.0\n"),
            "f:2: format is `ascii`, expected binary_little_endian, "
            "binary_big_endian or ascii, and version 1.0");
}

TEST(PlyFile, AListHasACountOfAnInteger) {
  const std::string Header = "ply\nformat ascii 1.0\nelement face 1\n";
  EXPECT_NE(errorOf(Header + "property list float int i\nend_header\n1 1\n"),
            "");
  EXPECT_NE(errorOf(Header + "property list char int i\nend_header\n-1\n"), "");
  EXPECT_EQ(errorOf(Header + "property list char int i\nend_header\n1 9\n"),
            "");
  // -1 in binary.
  EXPECT_NE(errorOf("ply\nformat binary_little_endian 1.0\nelement face 1\n"
                    "property list char int i\nend_header\n\xff"),
            "");
}

} // namespace
