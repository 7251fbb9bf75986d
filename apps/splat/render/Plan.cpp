#include "render/Plan.h"

#include "device/Kernels.h"
#include "effects/Registry.h"

#include <algorithm>
#include <cassert>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <iterator>
#include <map>
#include <mutex>
#include <set>
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

/// The words of the program \p File, which are those of all files that it
/// includes, whether by this plan or not.
const std::set<std::string, std::less<>> &wordsOf(const std::string &File) {
  static std::mutex Mutex;
  static std::map<std::string, std::set<std::string, std::less<>>> Known;
  const std::lock_guard Held(Mutex);
  const auto [At, IsNew] = Known.try_emplace(File);
  if (!IsNew)
    return At->second;
  const auto Text = programText(File);
  assert(Text && "a program that is planned is of this build");
  std::string Word;
  for (const char C : *Text + " ") {
    if (std::isalnum(static_cast<unsigned char>(C)) != 0 || C == '_') {
      Word += C;
    } else if (!Word.empty()) {
      At->second.insert(std::move(Word));
      Word.clear();
    }
  }
  return At->second;
}

/// Whether a kernel of \p P may use the macro that \p Define begins with.
bool uses(const ProgramSpec &P, const std::string &Define) {
  return wordsOf(P.File).contains(Define.substr(0, Define.find_first_of("=(")));
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

RenderPlan planRender(EffectPlan Effects, const RenderOptions &Options) {
  const bool Raster = Options.Blending == Path::Raster;
  const bool ByRay = Effects.done(effects::RayOrder);
  RenderPlan Plan{std::move(Effects),
                  {{ProjectProgram, "project.cl", {"VIEW_SPACE=__local"}},
                   {SortProgram, "sort.cl", {}},
                   {TilesProgram, "tiles.cl", {}},
                   {BlendProgram,
                    Raster  ? "rasterize.cl"
                    : ByRay ? "blend_by_ray.cl"
                            : "blend.cl",
                    {}}}};
  if (ByRay)
    Plan.Programs.push_back({RayFramesProgram, "ray_frames.cl", {}});
  if (Plan.Effects.done(effects::Windows))
    Plan.Programs.push_back(
        {WindowsProgram, "windows.cl", {"CROP_SPACE=__global"}});
  if (Plan.Effects.done(effects::ActivatedScene))
    Plan.Programs.push_back({ActivateProgram, "activate_scene.cl", {}});
  if (Plan.Effects.done(effects::CullBlocks))
    Plan.Programs.push_back({CullProgram, "cull_blocks.cl", {}});
  if (Plan.Effects.compiled(effects::ZTiles))
    Plan.Programs.push_back({MergeProgram, "merge.cl", {}});
  if (Plan.Effects.compiled(effects::Background))
    Plan.Programs.push_back({ResolveProgram, "resolve.cl", {}});
  if (Plan.Effects.done(effects::Depth))
    Plan.Programs.push_back({DepthProgram, "depth.cl", {}});
  if (Plan.Effects.done(effects::Normals))
    Plan.Programs.push_back({NormalsProgram, "normals.cl", {}});

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
