// splat-benchmark: what a renderer would have to do for a scene of the
// benchmark set with other parameters or other random numbers, estimated from a
// sample of its pixels; for bench/benchmark_fit.py, which needs thousands of
// such estimates. `splat analyze` counts all pixels. Not installed.

#include "analyze/ToReference.h"
#include "demo/BenchmarkScene.h"
#include "reference/Projection.h"
#include "reference/Tiles.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/Json.h"
#include "vorion/support/JsonShape.h"
#include "vorion/support/Tool.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace {

using namespace vorion;
using namespace vorion::splat;
using namespace vorion::splat::demo;
using Json = nlohmann::ordered_json;

constexpr const char *Usage =
    "expected KIND GAUSSIANS; prints the fitted parameters, and then what each "
    "line of standard input, a seed and parameters, gives";

struct Parameter {
  const char *Name;
  double BenchmarkShape::*Value;
};
constexpr std::array Parameters = {
    Parameter{"Distance", &BenchmarkShape::Distance},
    Parameter{"Second", &BenchmarkShape::Second},
    Parameter{"Third", &BenchmarkShape::Third},
    Parameter{"Behind", &BenchmarkShape::Behind},
    Parameter{"Nowhere", &BenchmarkShape::Nowhere},
    Parameter{"Back", &BenchmarkShape::Back},
    Parameter{"Fading", &BenchmarkShape::Fading},
    Parameter{"Clumps", &BenchmarkShape::Clumps},
    Parameter{"Size", &BenchmarkShape::Size},
    Parameter{"SizeSpread", &BenchmarkShape::SizeSpread},
    Parameter{"BlockSize", &BenchmarkShape::BlockSize},
    Parameter{"Stretch", &BenchmarkShape::Stretch},
    Parameter{"Large", &BenchmarkShape::Large},
    Parameter{"LargeSize", &BenchmarkShape::LargeSize},
    Parameter{"Depth", &BenchmarkShape::Depth},
    Parameter{"Opaque", &BenchmarkShape::Opaque},
    Parameter{"BlockOpaque", &BenchmarkShape::BlockOpaque},
    Parameter{"Most", &BenchmarkShape::Most},
    Parameter{"Faint", &BenchmarkShape::Faint},
    Parameter{"BlockFaint", &BenchmarkShape::BlockFaint}};
static_assert(sizeof(BenchmarkShape) == Parameters.size() * sizeof(double));

Json describe(const BenchmarkShape &Shape) {
  Json Values;
  for (const Parameter &P : Parameters)
    Values[P.Name] = Shape.*P.Value;
  return Values;
}

/// The parameters in \p Values, an object of numbers.
BenchmarkShape shapeOf(const Json &Values) {
  BenchmarkShape Shape{};
  for (const Parameter &P : Parameters)
    Shape.*P.Value = Values[P.Name];
  return Shape;
}

constexpr int Side = 16;                 ///< of a tile, pixels
constexpr int RowStep = 4, FirstRow = 1; ///< the rows of a tile in the sample
constexpr std::size_t Bins = 2048;       ///< of alpha, by its logarithm
const float BinsALog = static_cast<float>(Bins / std::log(255.0));

/// e^-X of 0 <= X < 80, to 5 digits: the sample's error is larger.
float decay(float X) {
  const float Power = -1.44269504F * X;
  const auto Whole = static_cast<int>(Power);
  const float F = Power - static_cast<float>(Whole);
  const float Part =
      1 + F * (0.693147F +
               F * (0.240227F +
                    F * (0.0555041F + F * (0.00961813F + F * 0.00133336F))));
  return std::bit_cast<float>((Whole + 127) << 23) * Part;
}

/// Sorted by value; those that are 0 do not count.
Json distribution(std::vector<uint32_t> Values) {
  std::erase(Values, 0U);
  std::ranges::sort(Values);
  Json Percentiles = Json::array();
  double Sum = 0;
  for (const uint32_t V : Values)
    Sum += V;
  for (std::size_t Percent = 0; Percent <= 100 && !Values.empty(); ++Percent)
    Percentiles.push_back(Values[Percent * (Values.size() - 1) / 100]);
  return {
      {"count", Values.size()},
      {"mean", Values.empty() ? 0 : Sum / static_cast<double>(Values.size())},
      {"percentiles", Percentiles}};
}

/// What the sample's pixels of a view count.
struct Sample {
  std::vector<uint32_t> Blends, Walked; ///< of each pixel
  std::array<uint64_t, 101> FullAt{};   ///< saturated after so many percent
  std::array<uint64_t, Bins> ByAlpha{};
  double AlphaSum = 0;

  /// Row \p Y of the tile at \p X0, through the tile's list.
  void addRow(const std::vector<uint32_t> &List,
              const std::vector<reference::Splat<float>> &Splats, int X0, int Y,
              int Width);
  Json alphas() const;
};

void Sample::addRow(const std::vector<uint32_t> &List,
                    const std::vector<reference::Splat<float>> &Splats, int X0,
                    int Y, int Width) {
  const auto Pixels = static_cast<std::size_t>(std::min(Side, Width - X0));
  std::array<float, Side> T, Alpha, Falls;
  std::array<uint32_t, Side> Count{}, Stop{};
  T.fill(1);
  std::size_t Open = Pixels;
  uint32_t Entry = 0;
  for (const uint32_t I : List) {
    ++Entry;
    const reference::Splat<float> &S = Splats[I];
    const float Dy = S.Mean.y - (static_cast<float>(Y) + 0.5F);
    if (std::abs(Dy) > S.Extent.y)
      continue;
    const float Yy = 0.5F * S.Conic[2] * Dy * Dy, Xy = S.Conic[1] * Dy,
                Xx = 0.5F * S.Conic[0];
    const float Start = S.Mean.x - (static_cast<float>(X0) + 0.5F);
    for (std::size_t K = 0; K < Side; ++K) {
      const float Dx = Start - static_cast<float>(K);
      const float Fall = std::clamp(Xx * Dx * Dx + Xy * Dx + Yy, 0.0F, 80.0F);
      Falls[K] = Fall;
      const float Wanted = std::min(0.99F, S.Opacity * decay(Fall));
      Alpha[K] = std::abs(Dx) <= S.Extent.x ? Wanted : 0.0F;
    }
    for (std::size_t K = 0; K < Pixels; ++K) {
      if (Alpha[K] < 1.0F / 255 || Stop[K] != 0)
        continue;
      const float Next = T[K] * (1 - Alpha[K]);
      if (Next < 1e-4F) {
        Stop[K] = Entry;
        --Open;
        continue;
      }
      T[K] = Next;
      ++Count[K];
      AlphaSum += double{Alpha[K]};
      const float Log = std::max(Falls[K] - std::log(S.Opacity), 0.01F);
      ++ByAlpha[std::min(static_cast<std::size_t>(Log * BinsALog), Bins - 1)];
    }
    if (Open == 0)
      break;
  }
  const auto Length = static_cast<uint32_t>(List.size());
  for (std::size_t K = 0; K < Pixels; ++K) {
    Blends.push_back(Count[K]);
    Walked.push_back(Stop[K] != 0 ? Stop[K] : Length);
    if (Stop[K] != 0)
      ++FullAt[(100 * Stop[K] + Length - 1) / Length];
  }
}

/// A bin's middle stands for what is in it.
Json Sample::alphas() const {
  uint64_t Count = 0;
  for (const uint64_t N : ByAlpha)
    Count += N;
  Json Percentiles = Json::array();
  uint64_t Below = 0;
  std::size_t Bin = Bins;
  for (std::size_t Percent = 0; Percent <= 100 && Count != 0; ++Percent) {
    while (Below <= Percent * (Count - 1) / 100)
      Below += ByAlpha[--Bin];
    Percentiles.push_back(
        std::exp(-(static_cast<double>(Bin) + 0.5) / double{BinsALog}));
  }
  return {{"count", Count},
          {"mean", Count ? AlphaSum / static_cast<double>(Count) : 0},
          {"percentiles", Percentiles}};
}

Json lists(const reference::TileLists &T) {
  std::vector<uint32_t> Lengths;
  Lengths.reserve(T.Lists.size());
  for (const auto &List : T.Lists)
    Lengths.push_back(static_cast<uint32_t>(List.size()));
  return {{"tiles", T.Lists.size()}, {"filled", distribution(Lengths)}};
}

/// As far as bench/benchmark_match.py reads it, what `splat analyze --support
/// box3 --json` has of the view.
Json viewReport(const reference::Gaussians<float> &G, const Camera &View) {
  reference::Options O;
  O.Reach = reference::Support::Box3;
  const auto Splats = reference::project(G, toReference<float>(View), O);
  const int Width = View.Width, Height = View.Height;
  const auto T = reference::tileLists(Splats, O.Reach, Side, Width, Height);
  Sample Counts;
  for (int Row = 0; Row < T.Grid.Rows; ++Row)
    for (int Column = 0; Column < T.Grid.Columns; ++Column)
      for (int Y = Row * Side + FirstRow;
           Y < std::min((Row + 1) * Side, Height); Y += RowStep)
        Counts.addRow(T.Lists[T.Grid.index(Column, Row)], Splats, Column * Side,
                      Y, Width);
  const auto Pixels = static_cast<double>(Counts.Blends.size());
  Json By16 = lists(T), Occluded = Json::array();
  uint64_t Full = 0;
  for (const uint64_t N : Counts.FullAt) {
    Full += N;
    Occluded.push_back(static_cast<double>(Full) / Pixels);
  }
  By16["occluded_by_percent"] = Occluded;
  const auto Covered =
      std::ranges::count_if(Counts.Blends, [](uint32_t N) { return N != 0; });
  return {{"lists",
           {{"16", By16},
            {"64", lists(reference::tileLists(Splats, O.Reach, 4 * Side, Width,
                                              Height))}}},
          {"alpha", Counts.alphas()},
          {"blends", distribution(Counts.Blends)},
          {"walked", distribution(Counts.Walked)},
          {"covered_share", static_cast<double>(Covered) / Pixels}};
}

std::optional<unsigned> number(const std::string &Word) {
  unsigned Value = 0;
  const char *const End = Word.data() + Word.size();
  const auto [Read, Failed] = std::from_chars(Word.data(), End, Value);
  return Failed == std::errc() && Read == End ? std::optional(Value)
                                              : std::nullopt;
}

/// A line of standard input: {"seed": 0, "parameters": {...}}.
Expected<Json> readRequest(const std::string &Line) {
  auto Request = parseJson<Json>(Line, "standard input", "a seed, parameters");
  if (!Request)
    return Request.error();
  std::vector<JsonField> Fields;
  Fields.reserve(Parameters.size());
  for (const Parameter &P : Parameters)
    Fields.push_back({P.Name, JsonShape::number()});
  if (auto Fits = JsonShape::object(
                      {{"seed", JsonShape::whole(0, 999)},
                       {"parameters", JsonShape::object(Fields).closed()}})
                      .closed()
                      .check(*Request, "standard input");
      !Fits)
    return Fits.error();
  return Request;
}

Json report(BenchmarkKind Kind, int Gaussians, const Json &Request) {
  const BenchmarkShape Shape = shapeOf(Request["parameters"]);
  Scene Made = makeBenchmark(Kind, Shape, Gaussians, Request["seed"]);
  // Colours count for nothing.
  Made.ShDegree = 0;
  Made.Sh.resize(3 * Made.size());
  const auto G = toReference<float>(Made);
  Json Views = Json::array();
  for (const Camera &View : benchmarkCameras(Kind, Shape.distances()))
    Views.push_back(viewReport(G, View));
  return Views;
}

Expected<Success> run(const std::vector<std::string> &Words) {
  const auto Kind = std::ranges::find_if(BenchmarkKinds, [&](BenchmarkKind K) {
    return !Words.empty() && name(K) == Words[0];
  });
  const auto Gaussians = Words.size() == 2 ? number(Words[1]) : std::nullopt;
  if (Kind == BenchmarkKinds.end() || !Gaussians || *Gaussians < 1000 ||
      *Gaussians > 2'000'000)
    return Error{"", Usage, ExitCode::Usage};
  const int Count = static_cast<int>(*Gaussians);
  const auto Say = [](const Json &Line) {
    printOut("{}\n", jsonText(Line));
    std::fflush(stdout);
  };
  Say(describe(benchmarkShape(*Kind, Count)));
  for (std::string Line; std::getline(std::cin, Line);) {
    const auto Request = readRequest(Line);
    if (!Request)
      return Request.error();
    Say(report(*Kind, Count, *Request));
  }
  return Success{};
}

} // namespace

int main(int Count, char **Words) {
  return runTool("splat-benchmark", [&] {
    const auto Done = run({Words + 1, Words + Count});
    return Done ? EXIT_SUCCESS : reportError("splat-benchmark", Done.error());
  });
}
