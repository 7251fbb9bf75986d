#include "Knobs.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace vorion::test {
namespace {

using splat::ExpUnit;
using splat::Path;
using splat::RenderOptions;
using splat::Support;

double none(const RenderOptions &, std::size_t) { return 0; }

/// A part that does not know that a pixel is full adds at most what was let
/// through before the stop: T, of which the next Gaussian would have left less
/// than the cut-off, and at least a hundredth.
double behindStop(const RenderOptions &O, std::size_t) {
  return std::min(1.0, 100 * double(O.Cutoff));
}

/// A unit's relative error of an alpha (docs/rasterizer.md), which moves a
/// colour by no more than that, two alphas on the other side of the smallest,
/// and a pixel that stops one Gaussian sooner or later.
double expUnit(const RenderOptions &O, std::size_t Gaussians) {
  constexpr double Relative[] = {0x1p-24, 2.85e-4, 2.7e-3, 1.1e-4, 7.2e-6,
                                 8.3e-5,  2.65e-5, 5.7e-3, 3.1e-2};
  return Relative[static_cast<std::size_t>(O.Exponential)] +
         2. * O.AlphaCutoff / 255 + behindStop(O, Gaussians);
}

/// Operands of the blend's multiplications rounded to a unit roundoff u: a
/// product is off by d = 2 u + u^2, a colour by 3 d / (1 - d) however many
/// layers there are. Proof: a weight r(a) r(T) is a T (1 + e), and r(c) r(w) is
/// c w (1 + e), each with |e| <= d. Let E be T's error before a layer and E'
/// behind it. T' = T - w gives E' = (1 - a) E - a e T, so
/// a |E| <= |E| - |E'| + d a T. Over all layers the sum of a |E| telescopes to
/// at most d times the sum of a T, which is at most 1 / (1 - d). A weight is
/// off by a E + a e T, so all together by 2 d / (1 - d), and the last roundings
/// add d. If one arithmetic reaches the cut-off and the other does not, the
/// layers behind add at most the other's T in front of this layer: the cut-off
/// over 1 - 0.99 (1 + d), the least share of T that a layer leaves.
double blendUnit(const RenderOptions &O, std::size_t Gaussians) {
  const bool Fp16 = O.Arithmetic == splat::BlendUnit::Fp16;
  const double U = unitRoundoff(O.Arithmetic);
  const double D = 2 * U + U * U;
  const double Behind = double(O.Cutoff) / (1 - 0.99 * (1 + D));
  // fp16's subnormal weights and colours are off by 2^-25 whatever they are,
  // and a T below its normal numbers, which only a lower cut-off leaves, by
  // itself.
  const double Subnormal = Fp16 ? 0x1p-25 * (double(Gaussians) + 1) +
                                      (O.Cutoff < 0x1p-14F ? 2 * 0x1p-14 : 0)
                                : 0;
  return 3 * D / (1 - D) + std::min(1.0, Behind) + Subnormal;
}

template <unsigned Size> void takeTile(RenderOptions &O) { O.Tile = Size; }

/// Of the picture, on both paths.
std::vector<Knob> pictureKnobs() {
  return {
      {"--support box3",
       "support",
       {},
       [](RenderOptions &O) { O.Reach = Support::Box3; },
       none},
      {"--support square3",
       "support",
       {},
       [](RenderOptions &O) { O.Reach = Support::Square3; },
       none},
      {"--support official16", "support", Path::Simt,
       [](RenderOptions &O) {
         O.Reach = Support::Official16;
         O.Tile = 16;
       },
       none},
      {"--rules gsplat",
       "rules",
       {},
       [](RenderOptions &O) { O.Convention = splat::Rules::Gsplat; },
       none},
      {"--antialiased",
       "antialiased",
       {},
       [](RenderOptions &O) { O.Antialiased = true; },
       none},
      {"--dilation 0",
       "dilation",
       {},
       [](RenderOptions &O) { O.Dilation = 0; },
       none},
      {"--dilation 1",
       "dilation",
       {},
       [](RenderOptions &O) { O.Dilation = 1; },
       none},
      {"--background 0.1,0.7,0.4",
       "background",
       {},
       [](RenderOptions &O) { O.Background = {0.1F, 0.7F, 0.4F}; },
       none},
      {"--cutoff 0",
       "cutoff",
       {},
       [](RenderOptions &O) { O.Cutoff = 0; },
       none},
      {"--cutoff 0.05",
       "cutoff",
       {},
       [](RenderOptions &O) { O.Cutoff = 0.05F; },
       none},
      {"--alpha-cutoff 2",
       "alpha-cutoff",
       {},
       [](RenderOptions &O) { O.AlphaCutoff = 2; },
       none},
      {"--alpha-cutoff 8",
       "alpha-cutoff",
       {},
       [](RenderOptions &O) { O.AlphaCutoff = 8; },
       none},
      {"--depth-bits 24",
       "depth-bits",
       {},
       [](RenderOptions &O) { O.DepthBits = 24; },
       none},
      {"--depth-bits 12",
       "depth-bits",
       {},
       [](RenderOptions &O) { O.DepthBits = 12; },
       none},
      {"--sh-degree 0",
       "sh-degree",
       {},
       [](RenderOptions &O) { O.ShLimit = 0; },
       none},
      {"--sh-degree 2",
       "sh-degree",
       {},
       [](RenderOptions &O) { O.ShLimit = 2; },
       none},
  };
}

/// Of the lane's units: those of both paths, then the rasterizer's.
std::vector<Knob> unitKnobs() {
  std::vector<Knob> All;
  const auto AddExps = [&](bool OnCores, std::optional<Path> Only) {
    for (const ExpUnit Unit : splat::ExpUnits)
      if (Unit != ExpUnit::Exact && splat::isOnCores(Unit) == OnCores)
        All.push_back({"--exp " + std::string(name(Unit)), "exp", Only,
                       [Unit](RenderOptions &O) { O.Exponential = Unit; },
                       expUnit});
  };
  AddExps(true, {});
  AddExps(false, Path::Raster);
  for (const splat::BlendUnit Unit : splat::BlendUnits)
    if (Unit != splat::BlendUnit::Fp32)
      All.push_back(
          {"--blend " + std::string(name(Unit)), "blend", Path::Raster,
           [Unit](RenderOptions &O) { O.Arithmetic = Unit; }, blendUnit});
  return All;
}

/// Of one path alone, and one that both have.
std::vector<Knob> pathKnobs() {
  return {
      {"--tile 16", "tile", Path::Raster, takeTile<16>, none},
      {"--tile 32", "tile", Path::Raster, takeTile<32>, none},
      {"--ztiles 2", "ztiles", Path::Raster,
       [](RenderOptions &O) { O.ZTiles = 2; }, behindStop},
      {"--ztiles 16", "ztiles", Path::Raster,
       [](RenderOptions &O) { O.ZTiles = 16; }, behindStop},
      {"--pixel-unit count:8", "pixel-unit", Path::Raster,
       [](RenderOptions &O) { O.PixelUnit.Count = 8; }, none},
      {"--pixel-unit occluded:0.5", "pixel-unit", Path::Raster,
       [](RenderOptions &O) { O.PixelUnit.OccludedShare = 0.5F; }, none},
      {"--pixel-unit last:1/4", "pixel-unit", Path::Raster,
       [](RenderOptions &O) {
         O.PixelUnit.LastOver = 1;
         O.PixelUnit.LastUnder = 4;
       },
       none},
      {"--skip-saturated", "skip-saturated", Path::Raster,
       [](RenderOptions &O) { O.SkipSaturated = true; }, none},
      {"--cull-blocks",
       "cull-blocks",
       {},
       [](RenderOptions &O) {
         O.CullBlocks = O.Optics->isPinhole() && !O.Rolling &&
                        O.Through == splat::Spread::Jacobian;
       },
       none},
      {"--tile 8", "cores' tile", Path::Simt, takeTile<8>, none},
      {"--tile 32", "cores' tile", Path::Simt, takeTile<32>, none},
      {"--tile 64", "cores' tile", Path::Simt, takeTile<64>, none},
      {"--simt-group 16", "simt-group", Path::Simt,
       [](RenderOptions &O) { O.SimtGroup = 16; }, none},
      {"--simt-group 64", "simt-group", Path::Simt,
       [](RenderOptions &O) { O.SimtGroup = 64; }, none},
  };
}

} // namespace

const std::vector<Knob> &knobs() {
  static const std::vector<Knob> All = [] {
    std::vector<Knob> List = pictureKnobs();
    for (const auto &More : {unitKnobs(), pathKnobs()})
      List.insert(List.end(), More.begin(), More.end());
    return List;
  }();
  return All;
}

double unitRoundoff(splat::BlendUnit B) {
  return std::ldexp(1.0, -static_cast<int>(significandBits(B)));
}

std::string flagsOf(Path P, const Setting &S) {
  std::string Flags = "--path " + std::string(name(P));
  for (const Knob *K : S)
    Flags += " " + K->Flags;
  return Flags;
}

RenderOptions turned(RenderOptions Base, Path P, const Setting &S) {
  Base.Blending = P;
  for (const Knob *K : S)
    K->Turn(Base);
  return Base;
}

double allowanceOf(const Setting &S, const RenderOptions &O,
                   std::size_t Gaussians) {
  double Sum = 0;
  for (const Knob *K : S)
    Sum += K->Allowance(O, Gaussians);
  return Sum;
}

std::vector<Setting> eachAlone(Path P) {
  std::vector<Setting> All{{}};
  for (const Knob &K : knobs())
    if (!K.Only || *K.Only == P)
      All.push_back({&K});
  return All;
}

Setting combination(Path P, uint32_t Seed) {
  std::mt19937 Engine(Seed);
  Setting S;
  std::size_t Begin = 0;
  const auto &All = knobs();
  while (Begin < All.size()) {
    // The knobs of one dimension stand together.
    const std::size_t End = static_cast<std::size_t>(
        std::find_if(All.begin() + static_cast<std::ptrdiff_t>(Begin),
                     All.end(),
                     [&](const Knob &K) {
                       return K.Dimension != All[Begin].Dimension;
                     }) -
        All.begin());
    const Knob &K = All[Begin + Engine() % (End - Begin)];
    const bool Turn = Engine() % 2 == 0;
    // Official16 has tiles of 16 pixels.
    const bool Fits = K.Dimension != "cores' tile" || S.empty() ||
                      std::ranges::none_of(S, [](const Knob *Other) {
                        return Other->Flags == "--support official16";
                      });
    if (Turn && Fits && (!K.Only || *K.Only == P))
      S.push_back(&K);
    Begin = End;
  }
  return S;
}

} // namespace vorion::test
