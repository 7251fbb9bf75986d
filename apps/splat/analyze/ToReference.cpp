#include "analyze/ToReference.h"

#include "reference/Lens.h"
#include "scene/Activation.h"

#include <algorithm>
#include <vector>

namespace vorion::splat {
namespace {

template <typename Real, typename From>
std::vector<glm::vec<3, Real>> rows3(const std::vector<From> &V) {
  std::vector<glm::vec<3, Real>> Rows;
  for (std::size_t I = 0; I + 2 < V.size(); I += 3)
    Rows.emplace_back(V[I], V[I + 1], V[I + 2]);
  return Rows;
}

} // namespace

template <typename Real>
reference::Gaussians<Real> toReference(const Scene &S) {
  const auto A = activate<Real>(S);
  reference::Gaussians<Real> G;
  G.Means = rows3<Real>(S.Means);
  G.Scales = rows3<Real>(A.Scales);
  for (std::size_t I = 0; I + 3 < A.Quats.size(); I += 4)
    G.Quats.emplace_back(A.Quats[I], A.Quats[I + 1], A.Quats[I + 2],
                         A.Quats[I + 3]);
  G.Opacities = A.Opacities;
  G.ShDegree = S.ShDegree;
  G.Sh = rows3<Real>(S.Sh);
  return G;
}

template <typename Real> reference::Camera<Real> toReference(const Camera &C) {
  reference::Camera<Real> R;
  R.Width = C.Width;
  R.Height = C.Height;
  const auto Rotation = C.worldToCameraRotation();
  const auto Translation = C.worldToCameraTranslation();
  for (int I = 0; I < 3; ++I) {
    for (int J = 0; J < 3; ++J)
      R.Rotation[J][I] = static_cast<Real>(Rotation[std::size_t(3) * I + J]);
    R.Translation[I] =
        static_cast<Real>(Translation[static_cast<std::size_t>(I)]);
    const double Centre = C.Position[static_cast<std::size_t>(I)];
    R.Centre[I] = static_cast<Real>(Centre);
    R.CentreLow[I] = static_cast<Real>(Centre - double(R.Centre[I]));
  }
  R.Focal = {C.Fx, C.Fy};
  R.Principal = {C.Cx, C.Cy};
  for (int J = 0; J < 3; ++J)
    R.DepthAxisLow[J] = static_cast<Real>(
        Rotation[std::size_t(6) + J] - static_cast<double>(R.Rotation[J][2]));
  R.DepthOffsetLow =
      static_cast<Real>(Translation[2] - static_cast<double>(R.Translation.z));
  if (!C.Optics.isPinhole())
    reference::setLens(R, *reference::lensModelNamed(C.Optics.Model->Name),
                       C.Optics.K);
  if (const auto &S = C.Optics.Shutter)
    R.Shutter = {S->Start,
                 S->Across,
                 S->Down,
                 {S->Motion[0], S->Motion[1], S->Motion[2]},
                 {S->Turn[0], S->Turn[1], S->Turn[2]}};
  return R;
}

static reference::Texture toReference(const Texture &T) {
  reference::Texture R;
  for (const Texture::Level &L : T.Levels) {
    auto &To = R.Levels.emplace_back();
    To.Width = static_cast<int>(L.Width);
    To.Height = static_cast<int>(L.Height);
    for (std::size_t I = L.First; I < L.First + L.Width * L.Height; ++I) {
      const uint32_t C = T.Texels[I];
      To.Texels.push_back(
          glm::dvec4(C & 255, C >> 8 & 255, C >> 16 & 255, C >> 24) / 255.0);
    }
  }
  return R;
}

static reference::MeshLook toReference(const Material &M) {
  using Look = reference::MeshLook;
  Look R;
  R.Picture = M.Picture ? static_cast<int>(*M.Picture) : -1;
  for (std::size_t A = 0; A < 2; ++A)
    R.Edges[A] = M.Sampling.Wraps[A] == Wrap::Repeat   ? Look::Edge::Repeat
                 : M.Sampling.Wraps[A] == Wrap::Mirror ? Look::Edge::Mirror
                                                       : Look::Edge::Clamp;
  R.MagnifiesLinearly = M.Sampling.MagnifiesLinearly;
  R.MinifiesLinearly = M.Sampling.MinifiesLinearly;
  R.Levels = M.Sampling.Levels == Sampler::Mips::None      ? Look::Mips::None
             : M.Sampling.Levels == Sampler::Mips::Nearest ? Look::Mips::Nearest
                                                           : Look::Mips::Linear;
  R.Cutoff = M.Alpha == AlphaMode::Mask ? double{M.Cutoff} : 0;
  R.IsTransparent = M.Alpha == AlphaMode::Blend;
  return R;
}

reference::Mesh toReference(const Mesh &M,
                            const std::optional<std::array<float, 3>> &Light) {
  reference::Mesh R;
  R.Positions = rows3<double>(M.Positions);
  for (std::size_t I = 0; I < M.Colors.size(); I += 4)
    R.Colors.emplace_back(M.Colors[I], M.Colors[I + 1], M.Colors[I + 2],
                          M.Colors[I + 3]);
  R.Corners = M.Corners;
  for (std::size_t I = 0; I < M.TextureCoordinates.size(); I += 2)
    R.Coordinates.emplace_back(M.TextureCoordinates[I],
                               M.TextureCoordinates[I + 1]);
  R.Normals = rows3<double>(M.Normals);
  for (const Material &Each : M.Materials)
    R.Looks.push_back(toReference(Each));
  R.LookOf = M.MaterialOf;
  for (const Texture &Each : M.Textures)
    R.Textures.push_back(toReference(Each));
  if (Light)
    R.Light = glm::dvec3((*Light)[0], (*Light)[1], (*Light)[2]);
  return R;
}

reference::Rules toReference(Rules R) {
  switch (R) {
  case Rules::Inria:
    return reference::Rules::Inria;
  case Rules::Gsplat:
    return reference::Rules::Gsplat;
  }
  return {};
}

reference::Support toReference(Support S) {
  switch (S) {
  case Support::Exact:
    return reference::Support::Exact;
  case Support::Box3:
    return reference::Support::Box3;
  case Support::Square3:
    return reference::Support::Square3;
  case Support::Official16:
    return reference::Support::Official16;
  }
  return {};
}

reference::Options toReference(const RenderOptions &O) {
  reference::Options R;
  R.Rule = toReference(O.Convention);
  R.Reach = toReference(O.Reach);
  R.Through = O.Through == Spread::Jacobian ? reference::Spread::Jacobian
                                            : reference::Spread::Unscented;
  R.Antialiased = O.Antialiased;
  R.Dilation = double{O.Dilation};
  R.LowPass = O.Kind == RendererKind::Surfel;
  R.FalloffDegree = static_cast<int>(O.FalloffDegree);
  R.Cutoff = double{O.Cutoff};
  R.AlphaCutoff = static_cast<int>(O.AlphaCutoff);
  R.DepthBits = static_cast<int>(O.DepthBits);
  R.Near = double{O.Near.value_or(0)}; // 0: the rules' own
  R.ShLimit = O.ShLimit;
  std::ranges::copy(O.Background, R.Background.begin());
  return R;
}

reference::Options toReference(const Drawing &D) {
  reference::Options R;
  R.Antialiased = D.Antialiased;
  R.Dilation = D.Dilation.value_or(R.Dilation);
  return R;
}

template reference::Gaussians<float> toReference(const Scene &);
template reference::Gaussians<double> toReference(const Scene &);
template reference::Camera<float> toReference(const Camera &);
template reference::Camera<double> toReference(const Camera &);

} // namespace vorion::splat
