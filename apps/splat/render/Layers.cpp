#include "render/Layers.h"

#include "io/Npz.h"

#include <cmath>

namespace vorion::splat {

namespace {

std::vector<std::size_t> shapeOf(const Image &I) {
  return {static_cast<std::size_t>(I.Height),
          static_cast<std::size_t>(I.Width)};
}

bool isOfFloats(const std::string &File) {
  return File.ends_with(".pfm") || File.ends_with(".exr");
}

/// The sums as they are, where the file has floats; else of unit length, with
/// -1 as black and 1 as white, and 0 where nothing is.
Expected<Success> writeNormals(const std::string &File, Image Sums) {
  if (File.ends_with(".npz"))
    return writeNpz(
        File,
        {{"normals", NpyArray::of({static_cast<std::size_t>(Sums.Height),
                                   static_cast<std::size_t>(Sums.Width), 3},
                                  Sums.Render)},
         {"alpha", NpyArray::of(shapeOf(Sums), Sums.Alpha)}});
  if (!isOfFloats(File))
    for (std::size_t P = 0; P < Sums.pixels(); ++P) {
      float *const N = Sums.Render.data() + 3 * P;
      const float Length = std::hypot(N[0], N[1], N[2]);
      for (std::size_t K = 0; K < 3; ++K)
        N[K] = 0.5F + (Length > 0 ? 0.5F * N[K] / Length : 0);
    }
  return writeImage(File, Sums);
}

Expected<Success> writeOpacity(const std::string &File, const Image &Picture) {
  if (File.ends_with(".npz"))
    return writeNpz(
        File, {{"opacity", NpyArray::of(shapeOf(Picture), Picture.Alpha)}});
  if (File.ends_with(".pfm"))
    return writeDepth(File, {Picture.Width, Picture.Height, Picture.Alpha, {}});
  Image Grey{Picture.Width, Picture.Height, {}, {}};
  for (const float A : Picture.Alpha)
    Grey.Render.insert(Grey.Render.end(), 3, A);
  return writeImage(File, Grey);
}

Expected<Success> writeContributors(const LayerFiles &F, const RenderResult &R,
                                    const RenderOptions &O) {
  const Contributors C = topContributors(*R.Lists, O, F.Top);
  std::vector<std::size_t> Shape = shapeOf(R.Picture);
  const NpyArray Counts = NpyArray::of(Shape, C.Counts);
  Shape.push_back(F.Top);
  return writeNpz(F.Contributors, {{"index", NpyArray::of(Shape, C.Indices)},
                                   {"weight", NpyArray::of(Shape, C.Weights)},
                                   {"count", Counts}});
}

} // namespace

std::vector<NamedFile> LayerFiles::named() const {
  return {{"--depth", Depth},
          {"--normals", Normals},
          {"--opacity", Opacity},
          {"--contributors", Contributors}};
}

DepthMap depthsOf(const RenderResult &R, const RenderOptions &O, DepthAs As) {
  const Image &Picture = R.Picture;
  if (As == DepthAs::Median)
    return {Picture.Width, Picture.Height, medianDepths(*R.Lists, O),
            Picture.Alpha};
  DepthMap D = *R.Depths;
  if (As == DepthAs::Expected)
    for (std::size_t P = 0; P < D.Depth.size(); ++P)
      D.Depth[P] = D.Alpha[P] > 0 ? D.Depth[P] / D.Alpha[P] : 0;
  return D;
}

Expected<Success> writeLayers(const LayerFiles &F, const RenderResult &R,
                              const RenderOptions &O) {
  Expected<Success> Written = Success{};
  if (!F.Depth.empty())
    Written = writeDepth(F.Depth, depthsOf(R, O, F.As));
  if (Written && !F.Normals.empty())
    Written = writeNormals(F.Normals, *R.Normals);
  if (Written && !F.Opacity.empty())
    Written = writeOpacity(F.Opacity, R.Picture);
  if (Written && !F.Contributors.empty())
    Written = writeContributors(F, R, O);
  return Written;
}

} // namespace vorion::splat
