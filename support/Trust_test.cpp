/// Folders that nobody else can write are trusted, and no others.
#include "FolderTest.h"

#include "vorion/support/Environment.h"
#include "vorion/support/KernelCacheFolder.h"
#include "vorion/support/Trust.h"

#include <cstdlib>
#include <fstream>
#include <grp.h>
#include <optional>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

using namespace vorion;
namespace fs = std::filesystem;

namespace {

/// Of nobody who runs this test.
constexpr uid_t Other = 12345;

class Trust : public FolderTest {
protected:
  fs::path folder() const { return fs::path(path("x")).parent_path(); }
  fs::path make(const std::string &Name, mode_t Mode = 0700) {
    const fs::path Made = folder() / Name;
    fs::create_directories(Made);
    EXPECT_EQ(chmod(Made.c_str(), Mode), 0);
    return Made;
  }
  static std::string why(const fs::path &Path) {
    return whyUntrusted(Path, geteuid());
  }
};

TEST_F(Trust, IsForWhatNobodyElseCanWrite) {
  EXPECT_EQ(why(make("own")), "");
  EXPECT_EQ(why(make("read", 0755)), "");
  for (const mode_t Mode : {0702, 0722, 01777}) {
    const fs::path Open = make("open", Mode);
    EXPECT_EQ(why(Open), Open.string() + " can be written by other users");
  }
  EXPECT_NE(why(folder() / "missing").find("No such file"), std::string::npos);
}

TEST_F(Trust, IsForFilesToo) {
  const fs::path File = make("own") / "file";
  std::ofstream(File) << "text";
  ASSERT_EQ(chmod(File.c_str(), 0644), 0);
  EXPECT_EQ(why(File), "");
  ASSERT_EQ(chmod(File.c_str(), 0646), 0);
  EXPECT_EQ(why(File), File.string() + " can be written by other users");
}

TEST_F(Trust, CountsEachFolderOnTheWay) {
  const fs::path Below = make("open/below");
  make("open", 0703);
  EXPECT_EQ(why(Below),
            (folder() / "open").string() + " can be written by other users");
  make("open", 01777);
  EXPECT_EQ(why(Below), "") << "others cannot rename what is in it";
}

TEST_F(Trust, FollowsLinks) {
  make("open", 0777);
  make("own");
  fs::create_directory_symlink(folder() / "open", folder() / "to-open");
  fs::create_directory_symlink(folder() / "own", folder() / "to-own");
  EXPECT_NE(why(folder() / "to-open"), "");
  EXPECT_EQ(why(folder() / "to-own"), "");
}

TEST_F(Trust, IsForOneOwnerAndRoot) {
  if (geteuid() != 0)
    GTEST_SKIP() << "only root gives files away";
  const fs::path Theirs = make("theirs"), Within = make("theirs/within");
  ASSERT_EQ(chown(Theirs.c_str(), Other, Other), 0);
  EXPECT_EQ(why(Theirs), Theirs.string() + " belongs to user 12345");
  EXPECT_EQ(why(Within), Theirs.string() + " belongs to user 12345");
  EXPECT_EQ(whyUntrusted(Theirs, Other), "");
  EXPECT_EQ(whyUntrusted(Within, Other),
            Within.string() + " belongs to user 0");
  // Its user and group are in no database: who is in the group is not known.
  ASSERT_EQ(chmod(Theirs.c_str(), 0770), 0);
  EXPECT_NE(whyUntrusted(Theirs, Other), "");
}

TEST_F(Trust, IsForGroupsOfOneUserAlone) {
  constexpr uid_t Daemon = 1;
  const passwd *User = getpwuid(Daemon);
  const group *Own = getgrgid(Daemon);
  if (geteuid() != 0 || !User || !Own || User->pw_gid != Daemon ||
      std::string(User->pw_name) != Own->gr_name || *Own->gr_mem)
    GTEST_SKIP() << "only root gives files away, to a user with a group";
  const fs::path Theirs = make("theirs");
  ASSERT_EQ(chown(Theirs.c_str(), Daemon, Daemon), 0);
  ASSERT_EQ(chmod(Theirs.c_str(), 0770), 0);
  EXPECT_EQ(whyUntrusted(Theirs, Daemon), "");
  ASSERT_EQ(chown(Theirs.c_str(), Daemon, Other), 0);
  EXPECT_EQ(whyUntrusted(Theirs, Daemon),
            Theirs.string() + " can be written by other users");
}

TEST_F(Trust, IsWhatAFolderIsMadeWith) {
  const fs::path Deep = folder() / "a" / "b" / "c";
  EXPECT_EQ(makeOwnFolder(Deep), "");
  EXPECT_EQ(fs::status(folder() / "a").permissions(), fs::perms::owner_all);
  EXPECT_EQ(why(Deep), "");
  EXPECT_EQ(makeOwnFolder(Deep), "") << "it is there";
  make("open", 0777);
  EXPECT_NE(makeOwnFolder(folder() / "open" / "x" / "y"), "");
  EXPECT_FALSE(fs::exists(folder() / "open" / "x"));
  std::ofstream(folder() / "file") << "text";
  EXPECT_EQ(makeOwnFolder(folder() / "file" / "x"),
            (folder() / "file").string() + ": cannot be made: Not a directory");
}

/// Variables are as before when it goes.
class Variable {
public:
  Variable(const char *NameIn, const std::optional<std::string> &Text)
      : Name(NameIn) {
    if (const char *Old = std::getenv(Name))
      Was = Old;
    set(Text);
  }
  ~Variable() { set(Was); }
  Variable(const Variable &) = delete;

private:
  void set(const std::optional<std::string> &Text) const {
    if (Text)
      setenv(Name, Text->c_str(), 1);
    else
      unsetenv(Name);
  }
  const char *Name;
  std::optional<std::string> Was;
};

TEST(Environment, TakesEmptyVariablesAsUnset) {
  const Variable Empty("TEST_VARIABLE", "");
  EXPECT_EQ(environmentVariable("TEST_VARIABLE"), nullptr);
  const Variable Set("TEST_VARIABLE", "text");
  EXPECT_STREQ(environmentVariable("TEST_VARIABLE"), "text");
}

class KernelCache : public Trust {
protected:
  void SetUp() override {
    Trust::SetUp();
    const fs::path Home = make("home");
    HomeIs.emplace("HOME", Home.string());
    InHome = (fs::canonical(Home) / ".cache/pocl/kcache").string();
  }

  std::string InHome;

private:
  // Without the variables that name it.
  Variable Given{"POCL_CACHE_DIR", std::nullopt};
  Variable Xdg{"XDG_CACHE_HOME", std::nullopt};
  std::optional<Variable> HomeIs;
};

TEST_F(KernelCache, IsInTheFirstGoodFolder) {
  EXPECT_EQ(findKernelCacheFolder().Path, InHome);
  EXPECT_EQ(findKernelCacheFolder("other").Path,
            fs::path(InHome).replace_filename("other"));
  const fs::path Own = make("xdg");
  const Variable IsSet("XDG_CACHE_HOME", Own.string());
  EXPECT_EQ(findKernelCacheFolder().Path, Own / "pocl/kcache");
  make("xdg", 0777);
  const KernelCacheFolder Found = findKernelCacheFolder();
  EXPECT_EQ(Found.Path, InHome);
  EXPECT_EQ(Found.PassedOver,
            std::vector<std::string>{Own.string() +
                                     " can be written by other users"});
}

TEST_F(KernelCache, IsNotInRelativeOrEmptyFolders) {
  for (const char *Text : {"", "relative"}) {
    const Variable Cache("XDG_CACHE_HOME", Text);
    EXPECT_EQ(findKernelCacheFolder().Path, InHome) << Text;
  }
  const Variable Empty("POCL_CACHE_DIR", "");
  EXPECT_EQ(findKernelCacheFolder().Path, InHome);
}

TEST_F(KernelCache, IsNowhereElseIfItIsNamed) {
  const fs::path Open = make("open", 0777);
  const Variable IsSet("POCL_CACHE_DIR", Open.string());
  const KernelCacheFolder Found = findKernelCacheFolder();
  EXPECT_EQ(Found.Path, "");
  EXPECT_EQ(Found.Problem, Open.string() + " can be written by other users");
}

} // namespace
