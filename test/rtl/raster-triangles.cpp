/// Draws triangle tiles that were simulated with the RTL of another rasterizer
/// on a simulated unit, through its CSRs, and compares each pixel
/// (docs/rtl.md, "Triangles of others").
#include "io/Npz.h"
#include "testing/LoneRasterizer.h"
#include "testing/RasterTile.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/Tool.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

using namespace vorion;
using namespace vorion::isasim;

namespace {

constexpr std::string_view Tool = "isasim-raster-triangles";

/// Of triangles and of records; far above any simulation, and below what a
/// file could unpack to.
constexpr size_t MostRows = size_t{1} << 20;

/// An array of integers in rows.
struct Rows {
  size_t Columns = 0;
  std::vector<int64_t> Values;
  size_t count() const { return Columns == 0 ? 0 : Values.size() / Columns; }
  const int64_t *operator[](size_t Row) const {
    return Values.data() + Row * Columns;
  }
};

/// Reads arrays of a file, and remembers the first error.
class Reader {
public:
  Reader(splat::NpzFile &From, const std::string &Path)
      : File(From), Path(Path) {}

  /// The array \p Name, whose rows have the extents \p Shape, 0 for any.
  Rows rows(const std::string &Name, const std::vector<size_t> &Shape) {
    const splat::NpyShape *Found = File.find(Name);
    if (!Found) {
      fail(Name, "is missing, expected the arrays of docs/rtl.md");
      return {};
    }
    const bool IsInteger = !Found->Type.starts_with('f') && //
                           !Found->Type.starts_with('U');
    bool Fits = IsInteger && Found->Shape.size() == Shape.size() + 1 &&
                Found->Shape[0] <= MostRows;
    for (size_t D = 0; Fits && D != Shape.size(); ++D)
      Fits = Shape[D] == 0 ? Found->Shape[D + 1] <= raster::VR_MAX_TILE
                           : Found->Shape[D + 1] == Shape[D];
    if (!Fits) {
      std::vector<std::string> Extents{"rows"};
      for (const size_t E : Shape)
        Extents.push_back(E == 0 ? "up to 64" : fmt::format("{}", E));
      fail(Name, fmt::format("is <{}> of shape ({}), expected integers of "
                             "shape ({}) with at most {} rows",
                             Found->Type, fmt::join(Found->Shape, ", "),
                             fmt::join(Extents, ", "), MostRows));
      return {};
    }
    const auto Array = File.read(Name);
    if (!Array) {
      if (!Failed)
        Failed = Array.error();
      return {};
    }
    Rows R{1, Array->toIntegers()};
    for (size_t D = 1; D != Found->Shape.size(); ++D)
      R.Columns *= Found->Shape[D];
    return R;
  }
  const std::vector<size_t> *shape(const std::string &Name) const {
    const splat::NpyShape *Found = File.find(Name);
    return Found ? &Found->Shape : nullptr;
  }
  void fail(const std::string &Name, const std::string &What) {
    if (!Failed)
      Failed = Error{Path + ": array " + Name, What};
  }
  const std::optional<Error> &error() const { return Failed; }

private:
  splat::NpzFile &File;
  std::string Path;
  std::optional<Error> Failed;
};

/// What the file holds of triangles (Tri) and of one of them in one tile each
/// (Rec).
struct Records {
  unsigned Side = 0; ///< of a tile, px
  Rows TriKind, TriEdges, TriWindow;
  Rows RecTriangle, RecTile, RecCorner, RecBits, RecCycles;
  std::vector<std::string> Kinds; ///< names, perhaps not of all

  std::string nameOf(int64_t Kind) const {
    return Kind >= 0 && static_cast<size_t>(Kind) < Kinds.size()
               ? Kinds[static_cast<size_t>(Kind)]
               : fmt::format("kind {}", Kind);
  }
};

template <typename Narrow> bool fits(int64_t Value) {
  return Value >= std::numeric_limits<Narrow>::min() &&
         Value <= std::numeric_limits<Narrow>::max();
}

template <typename Narrow> bool allFit(const Rows &R) {
  return std::ranges::all_of(R.Values, fits<Narrow>);
}

/// Checks what shapes do not say.
void check(const Records &R, Reader &From) {
  const auto Same = [&](const char *Name, const Rows &A, const char *With,
                        const Rows &B) {
    if (A.count() != B.count())
      From.fail(Name, fmt::format("has {} rows, expected {} as {} has",
                                  A.count(), B.count(), With));
  };
  Same("tri_kind", R.TriKind, "tri_edge_abc", R.TriEdges);
  Same("tri_window_x0x1y0y1", R.TriWindow, "tri_edge_abc", R.TriEdges);
  Same("rec_tile_xy", R.RecTile, "rec_tri", R.RecTriangle);
  Same("rec_edge_at_tile", R.RecCorner, "rec_tri", R.RecTriangle);
  Same("rec_cover_bits", R.RecBits, "rec_tri", R.RecTriangle);
  Same("rec_cycle_first_last_idle", R.RecCycles, "rec_tri", R.RecTriangle);
  if (From.error())
    return;
  for (const int64_t Triangle : R.RecTriangle.Values)
    if (Triangle < 0 || static_cast<size_t>(Triangle) >= R.TriEdges.count())
      return From.fail("rec_tri",
                       fmt::format("names triangle {}, expected 0 to {}",
                                   Triangle, R.TriEdges.count() - 1));
  for (const int64_t At : R.RecTile.Values)
    if (At < 0 || At > 65536 - int64_t{R.Side})
      return From.fail("rec_tile_xy", fmt::format("has {}, expected 0 to {}",
                                                  At, 65536 - int64_t{R.Side}));
  if (!allFit<int32_t>(R.TriEdges))
    From.fail("tri_edge_abc", "has a number of more than 32 bits");
  if (!allFit<int32_t>(R.RecCorner))
    From.fail("rec_edge_at_tile", "has a number of more than 32 bits");
  if (!allFit<uint8_t>(R.RecBits))
    From.fail("rec_cover_bits",
              "has a number outside 0 to 255, expected bytes");
  if (!allFit<int32_t>(R.RecCycles))
    From.fail("rec_cycle_first_last_idle", "has a number of more than 32 bits");
}

Expected<Records> readRecords(const std::string &Path) {
  auto File = splat::NpzFile::open(Path);
  if (!File)
    return File.error();
  Reader From(*File, Path);
  Records R;
  R.TriEdges = From.rows("tri_edge_abc", {3, 3});
  R.TriKind = From.rows("tri_kind", {});
  R.TriWindow = From.rows("tri_window_x0x1y0y1", {4});
  R.RecTriangle = From.rows("rec_tri", {});
  R.RecTile = From.rows("rec_tile_xy", {2});
  R.RecCorner = From.rows("rec_edge_at_tile", {3});
  R.RecBits = From.rows("rec_cover_bits", {0, 0});
  R.RecCycles = From.rows("rec_cycle_first_last_idle", {3});
  if (From.error())
    return *From.error();
  const auto &Bits = *From.shape("rec_cover_bits");
  R.Side = static_cast<unsigned>(Bits[1]);
  if (R.Side == 0 || Bits[2] * 8 != R.Side)
    From.fail("rec_cover_bits",
              fmt::format("has tiles of {} rows with {} bytes, expected a "
                          "square of 8 to 64 pixels, a bit each",
                          Bits[1], Bits[2]));
  if (!From.error())
    check(R, From);
  if (From.error())
    return *From.error();
  if (File->find("kind_names")) {
    const auto Names = File->read("kind_names");
    if (!Names)
      return Names.error();
    R.Kinds = Names->toTexts();
  }
  return R;
}

/// A rasterizer that draws records, one a command.
class Drawing {
public:
  explicit Drawing(unsigned SideIn) : Side(SideIn) {
    using raster::Csr;
    constexpr uint32_t First = 0;
    std::memcpy(Memory.range(List, sizeof(First)), &First, sizeof(First));
    Unit.set(Csr::Mode,
             raster::ModePrimitive.put(raster::VR_PRIMITIVE_TRIANGLE));
    Unit.set(Csr::Index, raster::VR_WORD_DEPTH);
    Unit.set(Csr::Word, Depth);
    Unit.set(Csr::Gaussians, Record);
    Unit.set(Csr::List, List);
    Unit.set(Csr::Count, 1);
    Unit.set(Csr::TileShape, raster::TileShapeWidth.put(Side) |
                                 raster::TileShapeHeight.put(Side));
    Unit.set(Csr::Output, Target);
    Unit.set(Csr::OutputPitch, Pitch);
  }

  raster::CommandWork draw(const raster::Triangle &T, uint32_t X, uint32_t Y) {
    std::memcpy(Memory.range(Record, sizeof(T)), &T, sizeof(T));
    Unit.set(raster::Csr::TileOrigin,
             raster::TileOriginX.put(X) | raster::TileOriginY.put(Y));
    return Unit.run();
  }
  /// Of the tile that was drawn last.
  bool isCovered(unsigned Column, unsigned Row) {
    raster::Visibility V;
    std::memcpy(&V,
                Memory.range(Target + Row * Pitch +
                                 Column * static_cast<uint32_t>(sizeof(V)),
                             sizeof(V)),
                sizeof(V));
    return V.Primitive != raster::VR_NO_PRIMITIVE;
  }

  /// VR_WORD_DEPTH: all that is covered is written.
  static constexpr uint32_t Depth =
      raster::DepthFunction.put(raster::VR_DEPTH_ALWAYS) |
      raster::DepthWrite.put(1);

private:
  static constexpr uint32_t List = 0x10000, Record = 0x10040, Target = 0x11000;
  static constexpr uint32_t Pitch =
      raster::VR_MAX_TILE * sizeof(raster::Visibility);
  unsigned Side;
  LoneMemory Memory{Target + raster::VR_MAX_TILE * Pitch};
  LoneRasterizer Unit{Memory};
};

uint32_t pixel(int64_t X, int64_t Y) {
  return static_cast<uint32_t>(X) | static_cast<uint32_t>(Y) << 16;
}

/// Record \p N as the unit takes it: edges as given, the window as its box.
raster::Triangle triangleOf(const Records &R, size_t N) {
  const auto Of = static_cast<size_t>(R.RecTriangle.Values[N]);
  const int64_t *Tile = R.RecTile[N], *Window = R.TriWindow[Of];
  raster::Triangle T{};
  for (size_t Edge = 0; Edge != 3; ++Edge) {
    const int64_t A = R.TriEdges[Of][3 * Edge],
                  B = R.TriEdges[Of][3 * Edge + 1];
    const int64_t C = R.RecCorner[N][Edge] - A * Tile[0] - B * Tile[1];
    T.A[Edge] = static_cast<int32_t>(A);
    T.B[Edge] = static_cast<int32_t>(B);
    T.CLow[Edge] = static_cast<uint32_t>(C);
    T.CHigh[Edge] = static_cast<int32_t>(C >> 32);
  }
  const auto Cut = [](int64_t V) { return std::clamp<int64_t>(V, 0, 65535); };
  // An empty window has its last pixel before its first.
  const bool IsEmpty = Window[0] >= Window[1] || Window[2] >= Window[3] ||
                       Window[1] <= 0 || Window[3] <= 0;
  T.First = IsEmpty ? pixel(1, 1) : pixel(Cut(Window[0]), Cut(Window[2]));
  T.Last = IsEmpty ? 0 : pixel(Cut(Window[1] - 1), Cut(Window[3] - 1));
  return T;
}

/// \p T in a tile of \p Side pixels at \p X, \p Y, for test/rtl.
RasterTile tileOf(const raster::Triangle &T, size_t N, unsigned Side,
                  uint32_t X, uint32_t Y) {
  RasterTile Tile;
  std::snprintf(Tile.What.Name.data(), Tile.What.Name.size(), "record %zu", N);
  Tile.What.X = X;
  Tile.What.Y = Y;
  Tile.What.Width = Tile.What.Height = Side;
  Tile.What.Gaussians = 1;
  Tile.What.Primitive = raster::VR_PRIMITIVE_TRIANGLE;
  Tile.What.Depth = Drawing::Depth;
  Tile.Input.resize(sizeof(T) / sizeof(uint32_t));
  std::memcpy(Tile.Input.data(), &T, sizeof(T));
  return Tile;
}

/// What came of the records of a kind.
struct Found {
  uint64_t Records = 0, Covered = 0, Wrong = 0;
  /// Cycles: of the RTL, and by the clock those of the lanes and of the whole
  /// command, with a box about what is covered and with all of the tile.
  uint64_t Rtl = 0, Lanes = 0, Command = 0, TileLanes = 0;

  Found &operator+=(const Found &O) {
    Records += O.Records;
    Covered += O.Covered;
    Wrong += O.Wrong;
    Rtl += O.Rtl;
    Lanes += O.Lanes;
    Command += O.Command;
    TileLanes += O.TileLanes;
    return *this;
  }
};

uint64_t lanesOf(const RasterTime &T) {
  uint64_t Sum = 0;
  for (const RasterCycle C :
       {RasterCycle::Blend, RasterCycle::Clip, RasterCycle::Hazard})
    Sum += T.Cycles[size_t(C)];
  return Sum;
}

/// \p Tiles: where the record goes as a tile, or null.
Found draw(const Records &R, size_t N, Drawing &Unit, uint32_t Latency,
           std::FILE *Tiles) {
  const auto X = static_cast<uint32_t>(R.RecTile[N][0]),
             Y = static_cast<uint32_t>(R.RecTile[N][1]);
  raster::Triangle T = triangleOf(R, N);
  if (Tiles)
    tileOf(T, N, R.Side, X, Y).write(Tiles);
  raster::CommandWork Work = Unit.draw(T, X, Y);
  Found F{.Records = 1,
          .Rtl =
              static_cast<uint64_t>(std::max<int64_t>(R.RecCycles[N][2], 0))};
  unsigned FirstX = R.Side, FirstY = R.Side, EndX = 0, EndY = 0;
  for (unsigned Row = 0; Row != R.Side; ++Row)
    for (unsigned Column = 0; Column != R.Side; ++Column) {
      const int64_t Byte = R.RecBits[N][(Row * R.Side + Column) / 8];
      const bool Expected = Byte >> Column % 8 & 1;
      F.Covered += Expected;
      F.Wrong += Work.hasFailed() || Unit.isCovered(Column, Row) != Expected;
      if (Expected) {
        FirstX = std::min(FirstX, Column);
        FirstY = std::min(FirstY, Row);
        EndX = std::max(EndX, Column + 1);
        EndY = std::max(EndY, Row + 1);
      }
    }
  F.TileLanes = lanesOf(timeAlone(std::move(Work), Latency));
  // Nothing is covered: a box that misses the tile.
  T.First = F.Covered == 0 ? 0xFFFFFFFF : pixel(X + FirstX, Y + FirstY);
  T.Last = F.Covered == 0 ? 0 : pixel(X + EndX - 1, Y + EndY - 1);
  const RasterTime Time = timeAlone(Unit.draw(T, X, Y), Latency);
  F.Lanes = lanesOf(Time);
  for (const uint64_t Cycles : Time.Cycles)
    F.Command += Cycles;
  return F;
}

constexpr const char *Line =
    "{:<20} {:>8} {:>9} {:>7} {:>9} {:>9} {:>9} {:>10}\n";

void print(const std::string &Name, const Found &F) {
  printOut(fmt::runtime(Line), Name, F.Records, F.Covered, F.Wrong, F.Rtl,
           F.Lanes, F.TileLanes, F.Command);
}

int run(const std::string &Path, uint32_t Latency,
        const std::string &TilesPath) {
  const auto R = readRecords(Path);
  if (!R)
    return reportError(Tool, R.error());
  std::FILE *Tiles =
      TilesPath.empty() ? nullptr : std::fopen(TilesPath.c_str(), "wb");
  if (!TilesPath.empty() && !Tiles)
    return reportError(Tool, {TilesPath, "cannot be written"});
  Drawing Unit(R->Side);
  std::map<int64_t, Found> Kinds;
  Found All;
  for (size_t N = 0; N != R->RecTriangle.count(); ++N) {
    const auto Of = static_cast<size_t>(R->RecTriangle.Values[N]);
    const Found F = draw(*R, N, Unit, Latency, Tiles);
    Kinds[R->TriKind.Values[Of]] += F;
    All += F;
  }
  if (Tiles && (std::ferror(Tiles) | std::fclose(Tiles)) != 0)
    return reportError(Tool, {TilesPath, "cannot be written"});
  printOut(fmt::runtime(Line), "kind", "records", "pixels", "differ", "RTL",
           "lanes", "by tile", "command");
  for (const auto &[Kind, F] : Kinds)
    print(R->nameOf(Kind), F);
  print("all", All);
  printOut("{} records, {} pixels differ\n", All.Records, All.Wrong);
  return All.Wrong == 0 ? 0 : 1;
}

} // namespace

int main(int Count, char **Values) {
  CLI::App App("Draws triangle tiles that were simulated with the RTL of "
               "another rasterizer on the simulated unit, and prints which "
               "pixels differ, and the cycles of both (docs/rtl.md).",
               std::string(Tool));
  App.footer("exit code 1: pixels differ\n" + std::string(ExitCodeHelp));
  std::string File, Tiles;
  uint32_t Latency = 10;
  takesFile(
      App.add_option("file", File, "Records of triangle tiles: an .npz file"))
      ->required();
  App.add_option("--latency", Latency, "Memory latency in cycles (default 10)")
      ->check(isBetween(uint64_t{0}, uint64_t{1} << 20));
  App.add_option("--tiles", Tiles,
                 "Write the records as tiles for isasim-raster-tiles");
  return runTool(Tool, [&] {
    if (const auto Ended = parseCommandLine(App, {Values + 1, Values + Count}))
      return *Ended;
    return run(File, Latency, Tiles);
  });
}
