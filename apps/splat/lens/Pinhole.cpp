// A pinhole: x/z, y/z.

#include "lens/Models.h"

namespace vorion::splat {

namespace {

constexpr std::string_view Names[] = {"PINHOLE"};
constexpr std::string_view OtherNames[] = {"SIMPLE_PINHOLE", "PERSPECTIVE"};
constexpr ColmapLens Colmap[] = {{0, "SIMPLE_PINHOLE", 1, 0},
                                 {1, "PINHOLE", 2, 0}};

} // namespace

const LensModel lenses::Pinhole{.Name = "PINHOLE",
                                .Names = Names,
                                .OtherNames = OtherNames,
                                .ViewerName = "perspective",
                                .Colmap = Colmap,
                                .WithCoefficients = &OpenCv,
                                .HoldsSlopes = true};

} // namespace vorion::splat
