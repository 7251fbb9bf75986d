/// Which programs a picture needs, and what is compiled into them.
#pragma once

#include "../device/Launcher.h"
#include "../io/Scene.h"
#include "Options.h"

#include <string>
#include <vector>

namespace vorion::splat {

/// The highest band of spherical harmonics of \p S with a coefficient that is
/// not zero: what a kernel has to evaluate.
int usedShDegree(const Scene &S);

/// Names of the programs, by which kernels are run.
inline constexpr const char *ProjectProgram = "project";
inline constexpr const char *SortProgram = "sort";
inline constexpr const char *ScanProgram = "scan";
inline constexpr const char *TilesProgram = "tiles";
inline constexpr const char *BlendProgram = "blend";
inline constexpr const char *MergeProgram = "merge";
inline constexpr const char *ResolveProgram = "resolve";

/// The smallest alpha that is blended, in 1/255.
std::string alphaCutoffDefine(const RenderOptions &O);
/// No opacity up to 1 makes a lower power visible, by a margin beyond any
/// unit's error.
std::string minPowerDefine(const RenderOptions &O);

/// The macros that the programs of one picture share: its tiles, square but for
/// training's, and what of a projection is compiled in.
std::vector<std::string> tileDefines(const RenderOptions &O);
std::vector<std::string> projectionDefines(int ShDegree,
                                           const RenderOptions &O);

struct RenderPlan {
  int ShDegree = 0; ///< compiled in
  std::vector<ProgramSpec> Programs;
};

/// The programs for \p S under \p Options. Effects that are not asked for and
/// bands that the scene has not are left out of them.
RenderPlan planRender(const Scene &S, const RenderOptions &Options);
/// The same with harmonics up to \p ShDegree, whatever they are.
RenderPlan planRender(int ShDegree, const RenderOptions &Options);

/// What \p Plan compiles in and leaves out, and why: a line each.
std::vector<std::string> explain(const RenderPlan &Plan, const Scene &S,
                                 const RenderOptions &Options);

} // namespace vorion::splat
