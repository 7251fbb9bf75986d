#include "device/Kernels.h"

#include "vorion/support/File.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>

namespace vorion::splat {
namespace {

std::size_t countOf(const std::string &Text, const std::string &Part) {
  std::size_t Count = 0;
  for (std::size_t At = Text.find(Part); At != std::string::npos;
       At = Text.find(Part, At + 1))
    ++Count;
  return Count;
}

class ProgramText : public testing::Test {
protected:
  ProgramText()
      : Folder(testing::TempDir() + "program-text-" +
               std::to_string(getpid())) {
    std::filesystem::create_directory(Folder);
  }
  ~ProgramText() override { std::filesystem::remove_all(Folder); }
  void write(const std::string &File, const std::string &Text) const {
    EXPECT_TRUE(writeFileAtomically(Folder + "/" + File, Text));
  }

  const std::string Folder;
};

TEST_F(ProgramText, HasEachFileOnce) {
  write("a.cl", "#include \"b.cl\"\n#include \"c.h\"\nint a;\n");
  write("b.cl", "#pragma once\n#include \"c.h\"\nint b;\n");
  write("c.h", "#pragma once\nint c;\n");
  const auto Text = programText("a.cl", Folder);
  ASSERT_TRUE(Text);
  EXPECT_EQ(countOf(*Text, "int c;"), 1U);
  EXPECT_LT(Text->find("int c;"), Text->find("int b;"));
  EXPECT_LT(Text->find("int b;"), Text->find("int a;"));
  EXPECT_EQ(countOf(*Text, "#pragma once"), 0U);
  EXPECT_EQ(countOf(*Text, "#line 3 \"a.cl\"\nint a;"), 1U);
}

// The first #include may be in a part that the macros leave out.
TEST_F(ProgramText, HasAFileAgainThatMayHaveBeenLeftOut) {
  write("a.cl", "#if X\n#include \"c.h\"\n#endif\n#include \"c.h\"\nint a;\n");
  write("c.h", "#pragma once\nint c;\n");
  const auto Text = programText("a.cl", Folder);
  ASSERT_TRUE(Text);
  EXPECT_EQ(countOf(*Text, "int c;"), 2U);
  EXPECT_EQ(countOf(*Text, "#ifndef INCLUDED_c_h"), 2U);
}

// What is left out may be the #line behind an #include.
TEST_F(ProgramText, NumbersLinesBehindPartsThatMayBeLeftOut) {
  write("a.cl", "#if X\n#include \"c.h\"\n#else\nint b;\n#endif\nint a;\n");
  write("c.h", "#pragma once\nint c;\n");
  const auto Text = programText("a.cl", Folder);
  ASSERT_TRUE(Text);
  EXPECT_EQ(countOf(*Text, "#else\n#line 4 \"a.cl\"\nint b;"), 1U);
  EXPECT_EQ(countOf(*Text, "#endif\n#line 6 \"a.cl\"\nint a;"), 1U);
}

TEST_F(ProgramText, FilesThatIncludeEachOtherEnd) {
  write("a.cl", "#include \"b.cl\"\nint a;\n");
  write("b.cl", "#include \"a.cl\"\nint b;\n");
  EXPECT_TRUE(programText("a.cl", Folder));
}

TEST_F(ProgramText, AMissingFileIsNamed) {
  write("a.cl", "#include \"missing.h\"\n");
  const auto Text = programText("a.cl", Folder);
  ASSERT_FALSE(Text);
  EXPECT_NE(Text.error().Where.find("missing.h"), std::string::npos);
  EXPECT_FALSE(programText("missing.cl"));
}

TEST(ProgramFiles, IncludeFilesOfTheProgram) {
  for (const std::string_view File : kernelFiles())
    EXPECT_TRUE(programText(std::string(File))) << File;
}

} // namespace
} // namespace vorion::splat
