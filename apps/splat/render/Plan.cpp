#include "Plan.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vorion::splat {

namespace {

std::string supportDefine(Support S) {
  switch (S) {
  case Support::Exact:
    return "SUPPORT_EXACT";
  case Support::Box3:
    return "SUPPORT_BOX3";
  case Support::Square3:
    return "SUPPORT_SQUARE3";
  case Support::Official16:
    return "SUPPORT_OFFICIAL16";
  }
  return {};
}

ProgramSpec projectProgram(int ShDegree, const RenderOptions &O) {
  ProgramSpec P{ProjectProgram,
                {"layout.h", "activate.cl", "covariance.cl", "support.cl",
                 "sh.cl", "project.cl"},
                projectionDefines(ShDegree, O)};
  P.Defines.push_back(supportDefine(O.Reach));
  P.Defines.push_back(alphaCutoffDefine(O));
  // Written so that a NaN depth is culled by both.
  P.Defines.emplace_back(O.Convention == Rules::Inria
                             ? "KEEP_DEPTH(z)=((z)>0.2f)"
                             : "KEEP_DEPTH(z)=((z)>=0.01f)");
  for (std::string &D : tileDefines(O))
    P.Defines.push_back(std::move(D));
  return P;
}

/// Of units.cl.
std::string falloffDefine(ExpUnit E) {
  switch (E) {
  case ExpUnit::Poly2:
    return "EXP_DEGREE=2";
  case ExpUnit::Poly3:
    return "EXP_DEGREE=3";
  case ExpUnit::Poly4:
    return "EXP_DEGREE=4";
  case ExpUnit::Linear:
    return "EXP_LINEAR";
  case ExpUnit::Schraudolph:
    return "EXP_SCHRAUDOLPH";
  default:
    return {};
  }
}

ProgramSpec blendProgram(const RenderOptions &O) {
  ProgramSpec P{BlendProgram, {"layout.h"}, tileDefines(O)};
  if (O.Training)
    P.Defines.emplace_back("KEEP_LAST");
  if (O.Blending == Path::Raster) {
    P.Files.insert(P.Files.end(), {"deal.cl", "rasterize.cl"});
    return P;
  }
  P.Defines.push_back(fmt::format("GROUP={}", O.SimtGroup));
  P.Defines.push_back(alphaCutoffDefine(O));
  P.Files.emplace_back(O.Exponential == ExpUnit::Exact ? "falloff.cl"
                                                       : "units.cl");
  if (const std::string Define = falloffDefine(O.Exponential); !Define.empty())
    P.Defines.push_back(Define);
  P.Files.emplace_back("blend.cl");
  P.Defines.push_back(minPowerDefine(O));
  if (O.Convention == Rules::Gsplat)
    P.Defines.emplace_back("STOP_AT_EQUAL");
  return P;
}

} // namespace

std::string alphaCutoffDefine(const RenderOptions &O) {
  return fmt::format("ALPHA_CUTOFF={}.0f", O.AlphaCutoff);
}

std::string minPowerDefine(const RenderOptions &O) {
  return fmt::format("MIN_POWER={:.6f}f",
                     std::log(O.AlphaCutoff / 255.0) - 0.06);
}

std::vector<std::string> tileDefines(const RenderOptions &O) {
  std::vector<std::string> Defines{fmt::format("TILE_SIZE={}", O.tileSize())};
  if (O.tileHeight() != O.tileSize())
    Defines.push_back(fmt::format("TILE_HEIGHT={}", O.tileHeight()));
  return Defines;
}

std::vector<std::string> projectionDefines(int ShDegree,
                                           const RenderOptions &O) {
  std::vector<std::string> Defines{fmt::format("SH_DEGREE={}", ShDegree),
                                   fmt::format("DILATION={:#}f", O.Dilation)};
  if (O.Antialiased) {
    Defines.emplace_back("ANTIALIASED");
    Defines.emplace_back(O.Convention == Rules::Inria
                             ? "ANTIALIAS_FLOOR=2.5e-5f"
                             : "ANTIALIAS_FLOOR=0.0f");
  }
  return Defines;
}

int usedShDegree(const Scene &S) {
  const std::size_t Stride = 3 * S.coefficients();
  for (int Degree = S.ShDegree; Degree > 0; --Degree) {
    const std::size_t First = 3 * shCoefficients(Degree - 1);
    const std::size_t Last = 3 * shCoefficients(Degree);
    for (std::size_t I = 0; I < S.size(); ++I) {
      const auto Begin = S.Sh.begin() + static_cast<std::ptrdiff_t>(I * Stride);
      if (std::any_of(Begin + static_cast<std::ptrdiff_t>(First),
                      Begin + static_cast<std::ptrdiff_t>(Last),
                      [](float V) { return V != 0; }))
        return Degree;
    }
  }
  return 0;
}

RenderPlan planRender(const Scene &S, const RenderOptions &Options) {
  return planRender(std::min(usedShDegree(S), Options.ShLimit), Options);
}

RenderPlan planRender(int ShDegree, const RenderOptions &Options) {
  RenderPlan Plan{ShDegree,
                  {projectProgram(ShDegree, Options),
                   {ScanProgram, {"scan.cl"}, {}},
                   {SortProgram, {"sort.cl"}, {}},
                   {TilesProgram, {"layout.h", "tiles.cl"}, {}},
                   blendProgram(Options),
                   {ResolveProgram, {"resolve.cl"}, {}}}};
  if (Options.ZTiles > 1)
    Plan.Programs.push_back({MergeProgram, {"merge.cl"}, {}});
  return Plan;
}

std::vector<std::string> explain(const RenderPlan &Plan, const Scene &S,
                                 const RenderOptions &Options) {
  std::vector<std::string> Lines;
  Lines.reserve(Plan.Programs.size() + MaxShDegree + 9);
  for (const ProgramSpec &P : Plan.Programs)
    Lines.push_back(
        fmt::format("program {}: {}{}{}", P.Name, fmt::join(P.Files, " "),
                    P.Defines.empty() ? "" : "; ", fmt::join(P.Defines, " ")));
  for (int Band = 0; Band <= MaxShDegree; ++Band) {
    if (Band <= Plan.ShDegree)
      Lines.push_back(fmt::format("SH band {}: compiled in", Band));
    else
      Lines.push_back(
          fmt::format("SH band {}: left out, {}", Band,
                      Band > Options.ShLimit
                          ? fmt::format("--sh-degree {}", Options.ShLimit)
                      : Band > S.ShDegree
                          ? fmt::format("the scene has degree {}", S.ShDegree)
                          : "all its coefficients in the scene are zero"));
  }
  Lines.emplace_back(
      Options.Antialiased
          ? "antialiasing: compiled in (--antialiased)"
          : "antialiasing: left out, it was not asked for (--antialiased)");
  Lines.push_back(fmt::format("support {}: compiled in, the others left out",
                              name(Options.Reach)));
  const bool Raster = Options.Blending == Path::Raster;
  Lines.push_back(fmt::format("rules {}: compiled in{}, the others left out",
                              name(Options.Convention),
                              Raster ? " but for the stop" : ""));
  Lines.emplace_back(
      Raster ? "blending: by the rasterizer (rasterize.cl); the cores' own "
               "(blend.cl) left out"
             : "blending: by the cores (blend.cl); the rasterizer's "
               "(rasterize.cl) left out, as --path simt asks");
  // The rasterizer takes these as options; nothing is compiled for them.
  Lines.push_back(
      Raster ? fmt::format("exponential unit {}: a field of vr_options",
                           name(Options.Exponential))
             : fmt::format("exponential {}: compiled in",
                           name(Options.Exponential)));
  if (Raster)
    Lines.push_back(fmt::format("blend arithmetic {}: a field of vr_options",
                                name(Options.Arithmetic)));
  Lines.push_back(
      fmt::format("alpha cut-off {}/255: {}", Options.AlphaCutoff,
                  Raster ? "a field of vr_options" : "compiled in"));
  Lines.push_back(
      fmt::format("cut-off {}: {}", Options.Cutoff,
                  Raster ? "vr_cutoff" : "an argument of the kernel"));
  Lines.push_back(fmt::format("stop at T' {} cut-off: {}",
                              Options.Convention == Rules::Gsplat ? "<=" : "<",
                              Raster ? "a bit of vr_options" : "compiled in"));
  if (Raster) {
    Lines.push_back(
        Options.ZTiles > 1
            ? fmt::format("z-tiles: {}, merged by merge.cl", Options.ZTiles)
            : "z-tiles: none, merge.cl left out (--ztiles)");
    Lines.push_back(fmt::format("saturated pixels: {}",
                                Options.SkipSaturated
                                    ? "no lane slot, a bit of vr_options"
                                    : "keep their lane slots"));
    Lines.push_back(
        fmt::format("pixel unit: {}", Options.PixelUnit.any()
                                          ? "vr_tail_* as --pixel-unit asks, " +
                                                toString(Options.PixelUnit)
                                          : "off (--pixel-unit)"));
  } else {
    Lines.push_back(fmt::format("tiles of {0}x{0} pixels, {1} work-items each: "
                                "compiled in",
                                Options.SimtTile, Options.SimtGroup));
  }
  Lines.emplace_back(
      !Raster
          ? "simulated on a Vorion device: the cores; the rasterizer is idle"
      : Options.PixelUnit.any()
          ? "simulated on a Vorion device: the cores, the rasterizers and the "
            "pixel units"
          : "simulated on a Vorion device: the cores and the rasterizers");
  return Lines;
}

} // namespace vorion::splat
