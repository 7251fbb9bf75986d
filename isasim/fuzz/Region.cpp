#include "fuzz/Targets.h"

#include "testing/SealedRegion.h"
#include "testing/TimedPrograms.h"
#include "tools/RegionRun.h"
#include "vorion/isasim/MemoryMap.h"
#include "vorion/support/File.h"
#include "vorion/support/TemporaryFolder.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace vorion::isasim::fuzz {

namespace {

using namespace testing;

constexpr uint64_t MaxInstructions = 5000;

/// Aborts unless \p Holds: what libFuzzer and the replaying test notice.
void require(bool Holds) {
  if (!Holds)
    std::abort();
}

/// What is printed of it is one line, whatever it names.
void requireOfFile(const Error &E) {
  require(!E.What.empty() && E.Code == ExitCode::InputFile);
}

/// Whether a machine and its clock are made, and looked through after each
/// launch, in little time.
bool isSmall(const Config &C) {
  constexpr uint64_t FewLanes = 256, FewBytes = 1 << 20, FewKib = 2048;
  const uint64_t Lanes = uint64_t{C.cores()} * C.WarpsPerCore * C.LanesPerWarp;
  return Lanes <= FewLanes && Lanes * C.StackBytes <= FewBytes &&
         globalBytes(C) <= FewBytes &&
         C.Timing.L2.Kib + C.Timing.Llc.Kib <= FewKib;
}

void restoreOne(std::span<const std::byte> File) {
  if (!isRegion(File))
    return;
  const auto Region = parseRegion(File, "input");
  if (!Region)
    return requireOfFile(Region.error());
  Config C = Region->Machine;
  if (!isSmall(C))
    return;
  C.Timing.Enabled = true;
  C.HostThreads = 1;
  C.MaxInstructions = MaxInstructions;
  require(bool(checkMachine(*Region, C, "input")));
  const auto M = Machine::create(C);
  const auto Watch = Session::create({}, "fuzz");
  require(M && Watch);
  (*M)->setConsole([](std::string_view) {});
  require(bool((*Watch)->attach(**M)));
  const auto Last =
      runRegion(*Region, **M, **Watch, true, "input", [](std::string_view) {});
  if (!Last)
    requireOfFile(Last.error());
}

Config tiny(unsigned Cores, unsigned Lanes) {
  Config C = timed(Cores);
  C.WarpsPerCore = 2;
  C.LanesPerWarp = Lanes;
  C.GlobalBytes = 1 << 14;
  C.LocalBytes = C.StackBytes = 4 << 10;
  C.Timing.L2.Kib = 64;
  C.MaxInstructions = MaxInstructions;
  return C;
}

/// Adds \p More to its data, and to a word of global memory. Pushes a Gaussian,
/// and lets the rasterizer drain an empty tile.
std::shared_ptr<const Image> counting(int32_t More) {
  using raster::Csr;
  constexpr uint32_t Data = VX_IMAGE_BASE + 0x1000;
  ElfOptions O;
  O.Segments.push_back(
      {VX_IMAGE_BASE, PF_R | PF_X,
       program({lui(7, VX_GLOBAL_BASE + 0x1000), lui(12, Data), lw(10, 0, 12),
                addi(10, 10, More), sw(10, 0, 12), sw(10, 0, 7),
                csrw(Csr::GTag, 10), csrw(Csr::Push, 0), lui(13, 0x80000),
                addi(13, 13, 8), csrw(Csr::TileShape, 13),
                addi(13, 0, raster::ModeDrain.put(1)), csrw(Csr::Mode, 13),
                csrw(Csr::Start, 0), csrr(14, Csr::Wait)})});
  O.Segments.push_back({Data, PF_R | PF_W, {7}, 20});
  const auto Program = Image::parse(buildElf(O), "counting");
  require(bool(Program));
  return *Program;
}

/// Two programs in turn, the first launch of which is before the region and the
/// second warms it up.
std::vector<std::byte> saved(const Config &C) {
  const auto Folder = TemporaryFolder::make("vorion-fuzz");
  const auto M = Machine::create(C);
  require(Folder && M);
  const std::string Path = Folder->path() + "/region";
  SessionOptions O;
  O.Region = "warm=2,from=3,save=" + Path;
  const auto Watch = Session::create(O, "fuzz");
  require(bool(Watch));
  require(bool((*Watch)->attach(**M)));
  const std::shared_ptr<const Image> Programs[] = {counting(1), counting(-1)};
  for (const unsigned Which : {0, 0, 1, 1}) {
    if ((*M)->image() != Programs[Which])
      (*M)->load(Programs[Which]);
    (*Watch)->runBegins(Which ? "second" : "first", VX_GLOBAL_BASE);
    const RunResult R = (*M)->run(VX_GLOBAL_BASE);
    require(R.End == Outcome::Done);
    require(bool((*Watch)->runEnded(R)));
  }
  const auto File = readFile(Path);
  require(bool(File));
  return *File;
}

} // namespace

void restore(std::span<const std::byte> Bytes) {
  restoreOne(Bytes);
  restoreOne(sealedRegion({Bytes.begin(), Bytes.end()}));
}

std::vector<std::vector<std::byte>> regionSeeds() {
  return {saved(tiny(1, 1)), saved(tiny(2, 4)), saved(tiny(1, 16))};
}

} // namespace vorion::isasim::fuzz
