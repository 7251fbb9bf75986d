#include "io/Hash.h"
#include "io/TestFiles.h"
#include "vorion/support/File.h"

#include <gtest/gtest.h>

namespace vorion::splat {
namespace {

// The values of the function's own specification.
TEST(Hash, GivesThePublishedValues) {
  EXPECT_EQ(fnv1a64(""), "cbf29ce484222325");
  EXPECT_EQ(fnv1a64("a"), "af63dc4c8601ec8c");
  EXPECT_EQ(fnv1a64("foobar"), "85944171f73967e8");
}

// Of XXH3_64bits, too.
TEST(Hash, GivesThePublishedValueOfNoBytesByXxh3) {
  EXPECT_EQ(Xxh3().value(), 0x2d06800538d394c2U);
}

// Larger than a chunk of what is read.
TEST(Hash, OfAFileIsThatOfItsBytes) {
  const TestFolder Folder;
  const std::string Bytes(200000, 'x');
  Folder.write("x", Bytes);
  Xxh3 Hash;
  Hash.add(std::as_bytes(std::span(Bytes)));
  EXPECT_EQ(*xxh3OfFile(Folder.path("x")), Hash.value());
  EXPECT_EQ(*fnv1a64OfFile(Folder.path("x")), fnv1a64(Bytes));
  EXPECT_FALSE(xxh3OfFile("/nonexistent-folder/x"));
  EXPECT_FALSE(fnv1a64OfFile("/nonexistent-folder/x"));
}

} // namespace
TEST(Hash, AFolderChangesWithTheNamesAndContentsOfItsFiles) {
  const TestFolder Folder;
  const auto Hash = [&] { return *hashScene(Folder.path("")); };
  Folder.write("meta.json", "{}");
  const std::string First = Hash();
  EXPECT_EQ(*hashScene(Folder.path("meta.json")), First);
  EXPECT_EQ(Hash(), First);
  Folder.write("meta.json", "{ }");
  const std::string Second = Hash();
  EXPECT_NE(Second, First);
  std::filesystem::create_directory(Folder.path("0_0"));
  Folder.write("0_0/plane.webp", "x");
  EXPECT_NE(Hash(), Second);
  EXPECT_FALSE(hashScene(Folder.path("absent")));
}

} // namespace vorion::splat
