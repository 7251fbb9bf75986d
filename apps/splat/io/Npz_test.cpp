#include "io/Image.h"
#include "io/Npz.h"
#include "io/TestFiles.h"

#include <fmt/format.h>

using namespace vorion;
using namespace vorion::splat;

namespace {

/// A version 1 .npy file with \p Header as written and \p Body.
std::string npy(std::string Header, const std::string &Body) {
  Header += '\n';
  std::string File = std::string("\x93NUMPY\1\0", 8);
  File += static_cast<char>(Header.size() & 0xff);
  File += static_cast<char>(Header.size() >> 8);
  return File + Header + Body;
}

std::string header(const std::string &Type, const std::string &Shape,
                   const std::string &Order = "False") {
  return fmt::format("{{'descr': '{}', 'fortran_order': {}, 'shape': {}, }}",
                     Type, Order, Shape);
}

Expected<NpyArray> parse(const std::string &File) {
  const auto *Data = reinterpret_cast<const std::byte *>(File.data());
  return parseNpy("a.npy", {Data, Data + File.size()});
}

TEST(Npz, RoundTripsEveryTypeAndShape) {
  const TestFolder Folder;
  Npz Arrays;
  Arrays["f4"] =
      NpyArray::of({2, 1, 2}, std::vector<float>{1, -2, 0.5F, 1e30F});
  Arrays["f8"] = NpyArray::of({3}, std::vector<double>{1e-300, 2, 3});
  Arrays["i4"] = NpyArray::of({}, std::vector<int32_t>{-7});
  Arrays["b1"] = NpyArray::fromBools({2, 2}, {1, 0, 0, 1});
  Arrays["none"] = NpyArray::of({0, 3}, std::vector<float>{});
  ASSERT_TRUE(writeNpz(Folder.path("a.npz"), Arrays));
  const auto Read = readNpz(Folder.path("a.npz"));
  ASSERT_TRUE(Read) << Read.error().What;
  ASSERT_EQ(Read->size(), Arrays.size());
  for (const auto &[Name, A] : Arrays) {
    const NpyArray &B = Read->at(Name);
    EXPECT_EQ(B.Type, A.Type) << Name;
    EXPECT_EQ(B.Shape, A.Shape) << Name;
    EXPECT_EQ(B.Bytes, A.Bytes) << Name;
  }
  EXPECT_EQ(Read->at("i4").toDoubles(), (std::vector<double>{-7}));
  EXPECT_EQ(Read->at("b1").toFloats(), (std::vector<float>{1, 0, 0, 1}));
}

TEST(Npz, EqualArraysMakeEqualFiles) {
  const TestFolder Folder;
  const Npz Arrays{{"a", NpyArray::of({2}, std::vector<float>{1, 2})}};
  ASSERT_TRUE(writeNpz(Folder.path("a.npz"), Arrays));
  ASSERT_TRUE(writeNpz(Folder.path("b.npz"), Arrays));
  EXPECT_EQ(Folder.read("a.npz"), Folder.read("b.npz"));
}

TEST(Npz, DataStartsAtAMultipleOf64) {
  const TestFolder Folder;
  // Shapes whose header texts have many lengths.
  std::size_t Extent = 1;
  for (int I = 0; I < 6; ++I, Extent *= 10) {
    Npz Arrays;
    Arrays["a"] = NpyArray::of({Extent}, std::vector<float>(Extent, 1));
    ASSERT_TRUE(writeNpz(Folder.path("a.npz"), Arrays));
    const auto Read = readNpz(Folder.path("a.npz"));
    ASSERT_TRUE(Read) << Read.error().What;
    EXPECT_EQ(Read->at("a").elements(), Extent);
  }
}

TEST(Npy, ReadsWhatNumpyWrites) {
  const auto Scalar = parse(npy(header("<i8", "()"), std::string(8, '\2')));
  ASSERT_TRUE(Scalar) << Scalar.error().What;
  EXPECT_TRUE(Scalar->Shape.empty());
  const auto Text =
      parse(npy(header("<U2", "()"), std::string("a\0\0\0b\0\0\0", 8)));
  ASSERT_TRUE(Text) << Text.error().What;
  EXPECT_EQ(Text->toText(), "ab");
  std::string Version2 = std::string("\x93NUMPY\2\0", 8);
  const std::string H = header("|u1", "(1,)") + "\n";
  Version2 += static_cast<char>(H.size()) + std::string(3, '\0') + H + "x";
  ASSERT_TRUE(parse(Version2));
  EXPECT_EQ(parse(Version2)->toDoubles(), (std::vector<double>{'x'}));
}

TEST(Npy, FortranOrderBecomesCOrder) {
  // [[1, 2, 3], [4, 5, 6]], first index fastest in the file.
  const std::string Columns("\1\4\2\5\3\6", 6);
  const auto A = parse(npy(header("|u1", "(2, 3)", "True"), Columns));
  ASSERT_TRUE(A) << A.error().What;
  EXPECT_EQ(A->toDoubles(), (std::vector<double>{1, 2, 3, 4, 5, 6}));
}

TEST(Npy, EachKindOfDamageHasItsMessage) {
  const auto Expect = [](const std::string &File, const char *Message) {
    const auto A = parse(File);
    ASSERT_FALSE(A) << Message;
    EXPECT_NE(A.error().What.find(Message), std::string::npos)
        << A.error().What;
  };
  const std::string Four(4, '\0');
  Expect("", "an empty file, expected a .npy array");
  Expect("\x93NUMPY\1", "is truncated in its header");
  Expect("\x93NUMPX1234567890", "expected a .npy array");
  Expect(std::string(16, '\1'), "not a .npy array");
  Expect(std::string("\x93NUMPY\7\0\0\0", 10), ".npy version 7");
  Expect(npy(header(">f4", "(1,)"), Four), "element type `>f4`");
  Expect(npy(header("<f2", "(2,)"), Four), "element type `<f2`");
  Expect(npy(header("", "(2,)"), Four), "element type ``");
  Expect(npy(header("<f4", "(2,)"), Four), "4 bytes of data, expected <f4");
  Expect(npy(header("<f4", "(4294967296, 4294967296)"), Four), "4 bytes");
  Expect(npy(header("<f4", "(99999999999999999999,)"), Four), "malformed");
  Expect(npy(header("<f4", "(-1,)"), Four), "malformed");
  Expect(npy(header("<f4", "(1,"), Four), "malformed");
  Expect(npy("{'descr': '<f4', }", Four), "malformed");
  std::string Axes = "(";
  for (int I = 0; I < 65; ++I)
    Axes += "1,";
  Expect(npy(header("|u1", Axes + "4)", "True"), Four), "an array of 66 axes");
}

TEST(Npy, EveryTruncationIsAnError) {
  const std::string File = npy(header("<f4", "(2,)"), std::string(8, '\0'));
  ASSERT_TRUE(parse(File));
  for (std::size_t Size = 0; Size < File.size(); ++Size)
    EXPECT_FALSE(parse(File.substr(0, Size))) << Size << " bytes";
}

TEST(Npz, TruncatedAndForeignArchivesAreErrors) {
  const TestFolder Folder;
  const Npz Arrays{{"a", NpyArray::of({2}, std::vector<float>{1, 2})}};
  ASSERT_TRUE(writeNpz(Folder.path("a.npz"), Arrays));
  const std::string File = Folder.read("a.npz");
  for (std::size_t Size = 0; Size < File.size(); ++Size)
    EXPECT_FALSE(readNpz(Folder.write("t.npz", File.substr(0, Size))))
        << Size << " bytes";
  EXPECT_FALSE(readNpz(Folder.write("t.npz", "no archive at all")));
  EXPECT_FALSE(readNpz(Folder.path("absent.npz")));
  // One bit of the compressed data flipped: the checksum does not match.
  std::string Damaged = File;
  Damaged[60] = static_cast<char>(Damaged[60] ^ 1);
  EXPECT_FALSE(readNpz(Folder.write("t.npz", Damaged)));
}

// What Deflate packs a thousandfold, under many names: an archive of
// kilobytes would be gigabytes.
TEST(Npz, EntriesThatShareTheirBytesDoNotMultiplyThem) {
  const TestFolder Folder;
  constexpr std::size_t Zeros = std::size_t(1) << 21;
  ASSERT_TRUE(
      writeNpz(Folder.path("a.npz"),
               {{"a", NpyArray::of({Zeros}, std::vector<float>(Zeros))}}));
  const std::string File = Folder.read("a.npz");
  const std::size_t Directory = File.rfind("PK\1\2"),
                    End = File.rfind("PK\5\6");
  const std::string Entry = File.substr(Directory, End - Directory);
  constexpr uint16_t Count = 500;
  std::string Many = File.substr(0, End), Tail = File.substr(End);
  for (int I = 1; I < Count; ++I)
    Many += Entry;
  const auto Size = static_cast<uint32_t>(Count * Entry.size());
  std::memcpy(Tail.data() + 8, &Count, sizeof(Count));
  std::memcpy(Tail.data() + 10, &Count, sizeof(Count));
  std::memcpy(Tail.data() + 12, &Size, sizeof(Size));
  const auto Read = readNpz(Folder.write("b.npz", Many + Tail));
  ASSERT_FALSE(Read);
  EXPECT_NE(Read.error().What.find("bytes of entries in an archive of"),
            std::string::npos)
      << Read.error().What;
}

TEST(Npz, PicturesOfTheWrongShapeAreErrors) {
  const TestFolder Folder;
  const auto Expect = [&](const Npz &Arrays, const char *Message) {
    ASSERT_TRUE(writeNpz(Folder.path("p.npz"), Arrays));
    const auto I = readImage(Folder.path("p.npz"));
    ASSERT_FALSE(I) << Message;
    EXPECT_NE(I.error().What.find(Message), std::string::npos);
  };
  const auto Four = NpyArray::of({2, 2}, std::vector<float>(4));
  const auto Picture = NpyArray::of({1, 2, 3}, std::vector<float>(6));
  Expect({{"other", Picture}}, "no array `render`");
  Expect({{"render", Four}}, "is not a picture");
  Expect({{"render", NpyArray::of({0, 2, 3}, std::vector<float>())}},
         "is not a picture");
  Expect({{"render", Picture}, {"alpha", Four}}, "size of `render`");
}

} // namespace
