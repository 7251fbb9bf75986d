// A region that was saved runs again as it did, and what is no such file is
// told.
#include "testing/SealedRegion.h"
#include "testing/TimedPrograms.h"
#include "tools/RegionRun.h"
#include "vorion/support/File.h"
#include "vorion/support/TemporaryFolder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>

namespace vorion::isasim {
namespace {

using namespace testing;

constexpr uint32_t Data = VX_IMAGE_BASE + 0x1000;
constexpr uint32_t Buffer = 0x100000;
constexpr int32_t StackShift = std::countr_zero(Config().StackBytes);

/// Adds up what the run before has left in memory, a raster CSR, the image's
/// data and the lane's stack, and leaves the sum and \p More in each.
std::shared_ptr<const Image> sums(int32_t More) {
  constexpr auto Csr = raster::Csr::Output;
  ElfOptions O;
  O.Segments.push_back(
      {VX_IMAGE_BASE, PF_R | PF_X,
       program({lw(10, 0, 7), csrr(11, Csr), lui(12, Data), lw(13, 0, 12),
                lui(14, VX_STACK_TOP - 0x1000), csrr(16, CSR_MHARTID),
                encode(Op::RV_SLLI, {.Rd = 16, .Rs1 = 16, .Imm = StackShift}),
                encode(Op::RV_SUB, {.Rd = 14, .Rs1 = 14, .Rs2 = 16}),
                lw(15, 0, 14),
                encode(Op::RV_ADD, {.Rd = 10, .Rs1 = 10, .Rs2 = 11}),
                encode(Op::RV_ADD, {.Rd = 10, .Rs1 = 10, .Rs2 = 13}),
                encode(Op::RV_ADD, {.Rd = 10, .Rs1 = 10, .Rs2 = 15}),
                addi(10, 10, More), sw(10, 0, 7), csrw(Csr, 10), sw(10, 0, 12),
                sw(10, 0, 14)})});
  O.Segments.push_back({Data, PF_R | PF_W, {7}, 60});
  auto Program = Image::parse(buildElf(O), "sums");
  EXPECT_TRUE(Program) << Program.error().What;
  return *Program;
}

/// Launches two programs in turn, as a driver does: each keeps its data, and in
/// between the host changes memory. Says what \p Region does not leave out.
class TwoPrograms {
public:
  explicit TwoPrograms(const std::string &Region) {
    SessionOptions O;
    O.Region = Region;
    auto Made = Session::create(O, "test");
    EXPECT_TRUE(Made) << Made.error().What;
    Watch = std::move(*Made);
    auto New = Machine::create(timed(2));
    EXPECT_TRUE(New);
    M = std::move(*New);
    EXPECT_TRUE(Watch->attach(*M));
  }

  void run(unsigned Count) {
    for (unsigned N = 0; N != Count; ++N) {
      const unsigned Which = Launches++ % 2;
      M->load(Programs[Which]);
      if (!Kept[Which].empty())
        EXPECT_TRUE(M->setImageData(Kept[Which]));
      const std::array<std::byte, 5> FromHost{std::byte(Launches)};
      EXPECT_TRUE(M->write(Buffer + 8, FromHost));
      Watch->runBegins(Which ? "second" : "first", 0);
      const RunResult R = M->run();
      EXPECT_EQ(R.End, Outcome::Done) << R.Report;
      if (R.Time)
        Times.push_back(toJson(*R.Time));
      const auto Ok = Watch->runEnded(R);
      EXPECT_TRUE(Ok) << Ok.error().What;
      Kept[Which] = M->imageData();
    }
  }

  std::unique_ptr<Session> Watch;
  std::unique_ptr<Machine> M;
  std::vector<std::string> Times;

private:
  const std::shared_ptr<const Image> Programs[2] = {sums(1), sums(5)};
  std::vector<std::byte> Kept[2];
  unsigned Launches = 0;
};

void quiet(std::string_view) {}

std::vector<std::byte> globalOf(const Machine &M) {
  const auto Bytes = M.memory().front();
  return {Bytes.begin(), Bytes.end()};
}

/// What a run of launches 3 to 6 of TwoPrograms leaves in a file.
std::vector<std::byte> savedFile() {
  const auto Folder = TemporaryFolder::make("region");
  EXPECT_TRUE(Folder);
  const std::string Path = Folder->path() + "/r.region";
  TwoPrograms(fmt::format("from=3,count=4,save={}", Path)).run(7);
  const auto File = readFile(Path);
  EXPECT_TRUE(File) << File.error().What;
  return *File;
}

} // namespace

TEST(Region, RunsAgainAsItDid) {
  for (const char *Choice : {"from=3,count=4", "warm=2,from=first:2,to=7",
                             "from=second:2,to=first:4", "from=1,count=6"}) {
    const auto Folder = TemporaryFolder::make("region");
    ASSERT_TRUE(Folder);
    const std::string Path = Folder->path() + "/r.region";
    TwoPrograms Saved(fmt::format("{},save={}", Choice, Path));
    Saved.run(6);
    const std::vector<std::byte> Left = globalOf(*Saved.M);
    Saved.run(2);
    const auto File = readFile(Path);
    ASSERT_TRUE(File) << File.error().What;
    ASSERT_TRUE(isRegion(*File));
    const auto Region = parseRegion(*File, Path);
    ASSERT_TRUE(Region) << Region.error().What;
    const auto Watch = Session::create({}, "test");
    ASSERT_TRUE(Watch);
    const auto M = Machine::create(Region->Machine);
    ASSERT_TRUE(M);
    ASSERT_TRUE((*Watch)->attach(**M));
    const auto Last = runRegion(*Region, **M, **Watch, true, Path, quiet);
    ASSERT_TRUE(Last) << Last.error().What;
    EXPECT_EQ(toJson(*Last->Time), Saved.Times.back()) << Choice;
    EXPECT_EQ(globalOf(**M), Left) << Choice;
  }
}

TEST(Region, IsTimedAlone) {
  TwoPrograms Whole("from=1"), Cold("from=3,count=2"), Warm("warm=1,from=3");
  Whole.run(6);
  Cold.run(6);
  Warm.run(6);
  ASSERT_EQ(Whole.Times.size(), 6U);
  EXPECT_EQ(Cold.Times.size(), 2U);
  // What warms up is all that there was.
  EXPECT_EQ(Warm.Times,
            std::vector(Whole.Times.begin() + 2, Whole.Times.end()));
  EXPECT_NE(Cold.Times.front(), Warm.Times.front());
  EXPECT_EQ(globalOf(*Cold.M), globalOf(*Whole.M));
}

TEST(Region, WhatNeverComesIsTold) {
  for (const auto &[Text, Message] :
       {std::pair("from=third", "region: from=third was not reached, expected "
                                "one of first:2, second:1"),
        std::pair("from=2,to=second:2", "region: to=second:2 was not reached, "
                                        "expected one of first:2, second:1"),
        std::pair(
            "from=2,count=3",
            "region: count=3 was not reached, launches since from=2: 2")}) {
    TwoPrograms P(Text);
    P.run(3);
    const auto Came = P.Watch->finished();
    ASSERT_FALSE(Came) << Text;
    EXPECT_EQ(Came.error().What, Message);
  }
  TwoPrograms Enough("warm=1,from=2,to=3");
  Enough.run(3);
  EXPECT_TRUE(Enough.Watch->finished());
}

TEST(Region, WrongSettingsAreTold) {
  for (const char *Text :
       {"", "from", "from=", "from=0", "from=:2", "from=a:", "from=a:0",
        "from=a:b", "count=0", "count=x", "to=1,count=1", "count=1,to=1",
        "save=", "form=1", "from=1,"}) {
    SessionOptions O;
    O.Region = Text;
    const auto Made = Session::create(O, "test");
    EXPECT_EQ(bool(Made), O.Region.empty()) << Text;
  }
}

TEST(Region, DamageIsTold) {
  const std::vector<std::byte> Good = savedFile();
  ASSERT_TRUE(parseRegion(Good, "r"));
  // Magic and version: a byte of the former makes it no region.
  for (size_t At = 14; At < Good.size();
       At += At < 600 ? 1 : Good.size() / 500) {
    std::vector<std::byte> Bad = Good;
    Bad[At] ^= std::byte(1);
    EXPECT_FALSE(parseRegion(Bad, "r")) << At;
    Bad.assign(Good.begin(), Good.begin() + static_cast<ptrdiff_t>(At));
    const auto Cut = parseRegion(Bad, "r");
    ASSERT_FALSE(Cut) << At;
    EXPECT_NE(Cut.error().What.find("truncated"), std::string::npos);
    EXPECT_EQ(Cut.error().Code, ExitCode::InputFile);
  }
}

/// A record begins with the size of a text, which is believed as far as there
/// are bytes; nothing is taken for it before.
TEST(Region, SizesBeyondTheFileAreTold) {
  const std::vector<std::byte> Good = savedFile();
  RecordHead Head;
  size_t At = RegionMagic.size() + sizeof(uint64_t);
  unsigned Number = 0; // of the record
  for (; At != Good.size(); At += Head.Bytes) {
    std::memcpy(&Head, Good.data() + At, sizeof(Head));
    At += sizeof(Head);
    ++Number;
    for (const uint64_t Size :
         {Head.Bytes, uint64_t{1} << 40, UINT64_MAX - 7, UINT64_MAX}) {
      std::vector<std::byte> Bad = Good;
      std::memcpy(Bad.data() + At, &Size, sizeof(Size));
      const auto R = parseRegion(sealedRegion(std::move(Bad)), "r");
      ASSERT_FALSE(R) << Number;
      EXPECT_EQ(R.error().What,
                fmt::format(
                    "record {} is damaged, expected an unmodified region file",
                    Number));
    }
  }
  EXPECT_EQ(Number, 7U); // a machine, two images, four launches
}

TEST(Region, AnImageThatIsNoneIsToldOfTheFile) {
  std::vector<std::byte> Bad = savedFile();
  const std::string_view Elf = ELFMAG;
  const auto At = std::ranges::search(Bad, std::as_bytes(std::span(Elf)));
  ASSERT_FALSE(At.empty());
  At.front() = std::byte(0);
  const auto R = parseRegion(sealedRegion(std::move(Bad)), "r");
  ASSERT_FALSE(R);
  EXPECT_EQ(R.error().Where, "r");
  EXPECT_EQ(R.error().What, "image 'sums': not an ELF file, expected an ELF "
                            "executable for RISC-V (32-bit)");
}

TEST(Region, AnotherMachineIsRefused) {
  const auto R = parseRegion(savedFile(), "r");
  ASSERT_TRUE(R);
  for (const auto &[Change, Fits] :
       {std::pair("timing.l2.kib=64,timing.core.preset=vortex-2025", true),
        std::pair("raster.queue_depth=9,host_threads=3", true),
        std::pair("cores_per_socket=1", false),
        std::pair("global_bytes=8388608", false),
        std::pair("stack_bytes=8192", false)}) {
    Config C = R->Machine;
    ASSERT_TRUE(setValues(C, Change));
    EXPECT_EQ(bool(checkMachine(*R, C, "r")), Fits) << Change;
  }
}

TEST(Region, OtherResultsAreTold) {
  auto R = parseRegion(savedFile(), "r");
  ASSERT_TRUE(R);
  R->Launches[1].PageBytes[0] ^= std::byte(1);
  const auto Watch = Session::create({}, "test");
  const auto M = Machine::create(R->Machine);
  ASSERT_TRUE(M);
  const auto Last = runRegion(*R, **M, **Watch, true, "r", quiet);
  ASSERT_FALSE(Last);
  EXPECT_NE(Last.error().What.find(
                "launch 2, second: the replay left different memory"),
            std::string::npos)
      << Last.error().What;
}

} // namespace vorion::isasim
