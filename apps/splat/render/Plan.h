/// Which programs a picture needs, and what is compiled into them.
#pragma once

#include "device/Launcher.h"
#include "effects/EffectPlan.h"
#include "picture/Options.h"

#include <string>
#include <vector>

namespace vorion::splat {

/// Names of the programs, by which kernels are run.
inline constexpr const char *ActivateProgram = "activate";
inline constexpr const char *CullProgram = "cull_blocks";
inline constexpr const char *ProjectProgram = "project";
inline constexpr const char *SortProgram = "sort";
inline constexpr const char *ScanProgram = "scan";
inline constexpr const char *TilesProgram = "tiles";
inline constexpr const char *BlendProgram = "blend";
inline constexpr const char *MergeProgram = "merge";
inline constexpr const char *ResolveProgram = "resolve";
inline constexpr const char *RayFramesProgram = "ray_frames";
inline constexpr const char *DepthProgram = "depth";
inline constexpr const char *NormalsProgram = "normals";
inline constexpr const char *WindowsProgram = "windows";

/// Which depths are drawn.
std::string keepDepthDefine(const RenderOptions &O);
/// The smallest alpha that is blended, in 1/255.
std::string alphaCutoffDefine(const RenderOptions &O);
/// No opacity up to 1 makes a lower power visible, by a margin beyond any
/// unit's error.
std::string minPowerDefine(const RenderOptions &O);

/// The macros that the programs of one picture share: its tiles, square but for
/// training's, and what of a projection the way back is compiled with.
std::vector<std::string> tileDefines(const RenderOptions &O);
std::vector<std::string> projectionDefines(int ShDegree,
                                           const RenderOptions &O);

struct RenderPlan {
  EffectPlan Effects;
  std::vector<ProgramSpec> Programs;
};

/// The programs for \p Effects under \p Options: each is built with the macros
/// of its own files and no others, so that what another needs does not make it
/// anew.
RenderPlan planRender(EffectPlan Effects, const RenderOptions &Options);
/// Of training, which knows no scene and decides nothing by data: harmonics up
/// to \p ShDegree, whatever they are, and all guards.
RenderPlan planRender(int ShDegree, const RenderOptions &Options);

} // namespace vorion::splat
