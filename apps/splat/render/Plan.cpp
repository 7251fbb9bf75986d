#include "render/Plan.h"

#include "device/Kernels.h"
#include "effects/Registry.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <string_view>
#include <utility>

namespace vorion::splat {

namespace {

/// Of the ratio of determinants whose root is the antialiasing factor, by both
/// rules (reference/Projection.h).
constexpr const char *AntialiasFloor = "ANTIALIAS_FLOOR=2.5e-5f";

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

/// The parameters of effects/Registry.h that hold for \p O.
std::vector<std::string> parameterDefines(const RenderOptions &O) {
  const bool Inria = O.Convention == Rules::Inria;
  std::vector<std::string> Defines = tileDefines(O);
  Defines.insert(
      Defines.end(),
      {supportDefine(O.Reach), fmt::format("DILATION={:#}f", O.Dilation),
       alphaCutoffDefine(O), keepDepthDefine(O), AntialiasFloor,
       fmt::format("GROUP={}", O.SimtGroup),
       fmt::format("RAY_WINDOW={}", O.RayWindow), minPowerDefine(O)});
  if (const std::string Define(defineOf(O.Exponential)); !Define.empty())
    Defines.push_back(Define);
  if (!Inria)
    Defines.emplace_back("STOP_AT_EQUAL");
  if (O.Deal == Dealing::LastFrame)
    Defines.emplace_back("KEEP_COUNTS");
  if (O.Training)
    Defines.insert(Defines.end(), {"KEEP_LAST", "KEEP_PLACES"});
  else
    Defines.emplace_back("SCENE_IN_BLOCKS");
  return Defines;
}

bool isWordCharacter(char C) {
  return std::isalnum(static_cast<unsigned char>(C)) != 0 || C == '_';
}

/// Whether \p Text says \p Word, and not as a part of a longer one.
bool containsWord(std::string_view Text, std::string_view Word) {
  for (std::size_t At = Text.find(Word); At != std::string_view::npos;
       At = Text.find(Word, At + 1)) {
    const std::size_t End = At + Word.size();
    if ((At == 0 || !isWordCharacter(Text[At - 1])) &&
        (End == Text.size() || !isWordCharacter(Text[End])))
      return true;
  }
  return false;
}

/// Whether a kernel of \p P says the macro that \p Define begins with.
bool uses(const ProgramSpec &P, const std::string &Define) {
  const std::string Macro = Define.substr(0, Define.find_first_of("=("));
  return std::ranges::any_of(P.Files, [&](const std::string &File) {
    return containsWord(kernelSource(File), Macro);
  });
}

/// What measures from a ray, beside the lens's files.
std::vector<std::string> cropFiles(const RenderOptions &O) {
  switch (O.Optics) {
  case LensModel::OpenCv:
    return {"crop.cl", "crop_opencv.cl"};
  case LensModel::Fisheye:
    return {"crop.cl", "crop_fisheye.cl"};
  case LensModel::Orthographic:
    return {"crop.cl", "crop_orthographic.cl"};
  case LensModel::Equirectangular:
    return {"crop.cl", "crop_equirectangular.cl"};
  default:
    return {"crop.cl", "crop_pinhole.cl"};
  }
}

} // namespace

// Written so that a NaN depth is culled by both rules.
std::string keepDepthDefine(const RenderOptions &O) {
  return fmt::format("KEEP_DEPTH(z)=((z){}{:#}f)",
                     O.Convention == Rules::Inria ? ">" : ">=", O.nearLimit());
}

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
    Defines.emplace_back(AntialiasFloor);
  }
  return Defines;
}

std::vector<std::string> lensFiles(const RenderOptions &O) {
  const bool Unscented = O.Through == Spread::Unscented;
  std::vector<std::string> Files;
  switch (O.Optics) {
  case LensModel::Pinhole:
    if (!Unscented && !O.Rolling)
      return {};
    Files = {"lens_pinhole.cl"};
    break;
  case LensModel::OpenCv:
    Files = {"lens_opencv.cl"};
    break;
  case LensModel::Fisheye:
    Files = {"lens_fisheye.cl"};
    break;
  case LensModel::Orthographic:
    Files = {"lens_orthographic.cl"};
    break;
  case LensModel::Equirectangular:
    Files = {"lens_equirectangular.cl"};
    break;
  }
  Files.emplace_back("lens.cl");
  if (O.Rolling)
    Files.emplace_back("rolling.cl");
  if (Unscented)
    Files.emplace_back("unscented.cl");
  return Files;
}

RenderPlan planRender(EffectPlan Effects, const RenderOptions &Options) {
  const bool Raster = Options.Blending == Path::Raster;
  const std::string Falloff(kernelOf(Options.Exponential));
  const char *Deal =
      Options.Deal == Dealing::LastFrame ? "deal_last_frame.cl" : "deal.cl";
  RenderPlan Plan{
      std::move(Effects),
      {{ProjectProgram,
        {"layout.h", "has_lens.h", "activate.cl", "covariance.cl", "support.cl",
         "planes.h", "sh_basis.h", "sh.cl", "rectangle.cl", "camera_depth.cl"},
        {"VIEW_SPACE=__local"}},
       {SortProgram, {"sort.cl"}, {}},
       {TilesProgram, {"layout.h", "rectangle.cl", "tiles.cl"}, {}},
       {BlendProgram,
        Raster ? std::vector<std::string>{"layout.h", "window.h", Deal,
                                          "rasterize.cl"}
               : std::vector<std::string>{"layout.h", "window.h", Falloff,
                                          "blend.cl"},
        {}}}};
  if (Plan.Effects.done(effects::RayOrder)) {
    Plan.Programs.back().Files.emplace_back("blend_by_ray.cl");
    Plan.Programs.push_back({RayFramesProgram,
                             {"layout.h", "activate.cl", "covariance.cl",
                              "planes.h", "ray_frames.cl"},
                             {}});
  }
  auto &Project = Plan.Programs.front().Files;
  std::ranges::copy(lensFiles(Options), std::back_inserter(Project));
  if (Plan.Effects.done(effects::Needles))
    Project.emplace_back("across.cl");
  if (Plan.Effects.done(effects::Crop))
    std::ranges::copy(cropFiles(Options), std::back_inserter(Project));
  Project.emplace_back("project_memory.cl");
  if (Plan.Effects.done(effects::EquirectangularLens))
    Project.emplace_back("project_copies.cl");
  Project.emplace_back("project.cl");
  if (Plan.Effects.done(effects::Windows)) {
    ProgramSpec Windows{WindowsProgram,
                        {"layout.h", "has_lens.h", "activate.cl",
                         "covariance.cl", "planes.h", "rectangle.cl"},
                        {"CROP_SPACE=__global"}};
    std::ranges::copy(lensFiles(Options), std::back_inserter(Windows.Files));
    std::ranges::copy(cropFiles(Options), std::back_inserter(Windows.Files));
    Windows.Files.emplace_back("windows.cl");
    Plan.Programs.push_back(std::move(Windows));
  }
  if (Plan.Effects.done(effects::ActivatedScene))
    Plan.Programs.push_back(
        {ActivateProgram,
         {"layout.h", "activate.cl", "planes.h", "activate_scene.cl"},
         {}});
  if (Plan.Effects.done(effects::CullBlocks))
    Plan.Programs.push_back(
        {CullProgram,
         {"layout.h", "activate.cl", "covariance.cl", "cull_blocks.cl"},
         {}});
  if (Plan.Effects.compiled(effects::ZTiles))
    Plan.Programs.push_back({MergeProgram, {"merge.cl"}, {}});
  if (Plan.Effects.compiled(effects::Background))
    Plan.Programs.push_back({ResolveProgram, {"resolve.cl"}, {}});
  if (Plan.Effects.done(effects::Depth))
    Plan.Programs.push_back({DepthProgram, {"layout.h", "depth.cl"}, {}});
  if (Plan.Effects.done(effects::Normals))
    Plan.Programs.push_back(
        {NormalsProgram,
         {"layout.h", "activate.cl", "covariance.cl", "planes.h", "normals.cl"},
         {}});

  std::vector<std::string> Defines = parameterDefines(Options);
  for (std::string &Define : Plan.Effects.defines())
    Defines.push_back(std::move(Define));
  for (ProgramSpec &P : Plan.Programs)
    std::ranges::copy_if(Defines, std::back_inserter(P.Defines),
                         [&](const std::string &D) { return uses(P, D); });
  return Plan;
}

RenderPlan planRender(int ShDegree, const RenderOptions &Options) {
  return planRender(EffectPlan::forAnyScene(ShDegree, Options), Options);
}

} // namespace vorion::splat
