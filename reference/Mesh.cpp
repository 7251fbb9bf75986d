#include "Mesh.h"

#include "Footprint.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace vorion::reference {
namespace {

constexpr double Infinity = std::numeric_limits<double>::infinity();

/// Half a sub-pixel, px.
constexpr double HalfStep = 1.0 / 512;
/// Rounding of depths, relative to the largest 1/z of the corners; and of
/// texels' places, in texels.
constexpr double DepthRounding = 1e-6, TexelRounding = 2e-3;

glm::dvec3 inCamera(const Camera<double> &C, const glm::dvec3 &P) {
  return C.Rotation * P + C.Translation;
}

bool isParallel(const Camera<double> &C) { return !C.Optics.isPinhole(); }

double linearOf(double Stored) {
  return Stored <= 0.04045 ? Stored / 12.92
                           : std::pow((Stored + 0.055) / 1.055, 2.4);
}

double storedOf(double Linear) {
  return Linear <= 0.0031308 ? 12.92 * Linear
                             : 1.055 * std::pow(Linear, 1 / 2.4) - 0.055;
}

/// A triangle of the picture. A point (x, y) of it is the sum of shares times
/// (x_k w_k, y_k w_k, w_k) of the corners, with w = z, or 1 for parallel rays.
class Projected {
public:
  Projected(const Mesh &M, const Camera<double> &C, std::size_t T)
      : IsParallel(isParallel(C)) {
    glm::dvec3 H[3];
    for (int K = 0; K < 3; ++K) {
      const glm::dvec3 P = inCamera(
          C, M.Positions[M.Corners[3 * T + static_cast<std::size_t>(K)]]);
      Z[K] = P.z;
      const double W = IsParallel ? 1 : P.z;
      H[K] = {C.Focal.x * P.x + C.Principal.x * W,
              C.Focal.y * P.y + C.Principal.y * W, W};
      if (W > 0)
        Corner[K] = glm::dvec2(H[K]) / W;
    }
    for (int K = 0; K < 3; ++K)
      Edge[K] = glm::cross(H[(K + 1) % 3], H[(K + 2) % 3]);
    Area = glm::dot(H[0], Edge[0]);
    if (Area < 0) {
      Area = -Area;
      for (glm::dvec3 &E : Edge)
        E = -E;
    }
  }

  /// Pixels that it may cover: x0, y0, x1, y1.
  std::array<int, 4> box(const Camera<double> &C, double Near) const {
    if (std::min({Z[0], Z[1], Z[2]}) < Near) // cut by the near plane
      return {0, 0, C.Width, C.Height};
    const auto At = [](double Value, int Most) {
      return static_cast<int>(std::clamp(Value, 0.0, double(Most)));
    };
    const auto [X0, X1] = std::minmax({Corner[0].x, Corner[1].x, Corner[2].x});
    const auto [Y0, Y1] = std::minmax({Corner[0].y, Corner[1].y, Corner[2].y});
    return {At(std::floor(X0 - 1), C.Width), At(std::floor(Y0 - 1), C.Height),
            At(std::ceil(X1 + 1), C.Width), At(std::ceil(Y1 + 1), C.Height)};
  }

  /// Shares of the corners at (\p X, \p Y), which sum to 1 in space.
  glm::dvec3 shares(double X, double Y) const {
    const glm::dvec3 At(X, Y, 1);
    const glm::dvec3 S(glm::dot(At, Edge[0]), glm::dot(At, Edge[1]),
                       glm::dot(At, Edge[2]));
    return S / (S.x + S.y + S.z);
  }

  double depth(double X, double Y) const {
    return glm::dot(shares(X, Y), glm::dvec3(Z[0], Z[1], Z[2]));
  }

  /// How far inside of the nearest edge, in steps by which a corner may move
  /// along both axes, px.
  double inside(double X, double Y) const {
    double Least = Infinity;
    for (const glm::dvec3 &E : Edge)
      Least = std::min(Least, glm::dot(glm::dvec3(X, Y, 1), E) /
                                  (std::abs(E.x) + std::abs(E.y)));
    return Least;
  }

  double slack(double X, double Y, double Near) const {
    const double D = depth(X, Y);
    double Moved = 0;
    for (const glm::dvec2 &Step : {glm::dvec2(HalfStep, 0), {0, HalfStep}})
      Moved += std::abs(depth(X + Step.x, Y + Step.y) - D);
    const double Nearest =
        IsParallel ? 1 : D / std::max(Near, std::min({Z[0], Z[1], Z[2]}));
    return Moved + DepthRounding * std::abs(D) * Nearest;
  }

  bool hasArea() const { return Area > 0; }

private:
  bool IsParallel;
  glm::dvec3 Edge[3];
  glm::dvec2 Corner[3]{};
  double Z[3]{};
  double Area = 0;
};

/// Where a texture is sampled along one axis.
struct Place {
  int First = 0, Second = 0;
  double Part = 0; ///< of the second
  bool Doubtful = false;
};

int wrapped(int At, int Size, MeshLook::Edge Edge) {
  const auto Modulo = [](int A, int B) { return ((A % B) + B) % B; };
  switch (Edge) {
  case MeshLook::Edge::Repeat:
    return Modulo(At, Size);
  case MeshLook::Edge::Mirror: {
    const int In = Modulo(At, 2 * Size);
    return In < Size ? In : 2 * Size - 1 - In;
  }
  case MeshLook::Edge::Clamp:
    return std::clamp(At, 0, Size - 1);
  }
  return 0;
}

Place placeOf(double Coordinate, int Size, MeshLook::Edge Edge, bool IsLinear) {
  Place P;
  const double At = Coordinate * Size - (IsLinear ? 0.5 : 0);
  const double Low = std::floor(At);
  const auto Texel =
      static_cast<int>(Low - std::floor(Low / (2.0 * Size)) * 2.0 * Size);
  const int Held = Edge == MeshLook::Edge::Clamp
                       ? static_cast<int>(std::clamp(Low, -1.0, double(Size)))
                       : Texel;
  P.First = wrapped(Held, Size, Edge);
  P.Second = wrapped(Held + 1, Size, Edge);
  P.Part = IsLinear ? At - Low : 0;
  P.Doubtful = !IsLinear && std::abs(At - std::round(At)) < TexelRounding;
  return P;
}

glm::dvec4 linearTexel(const Texture::Level &L, int X, int Y) {
  const glm::dvec4 &T =
      L.Texels[static_cast<std::size_t>(Y) * static_cast<std::size_t>(L.Width) +
               static_cast<std::size_t>(X)];
  return {linearOf(T.x), linearOf(T.y), linearOf(T.z), T.w};
}

MeshColor sampleLevel(const MeshLook &Look, const Texture::Level &L,
                      bool IsLinear, glm::dvec2 At) {
  const Place X = placeOf(At.x, L.Width, Look.Edges[0], IsLinear),
              Y = placeOf(At.y, L.Height, Look.Edges[1], IsLinear);
  const auto Row = [&](int Y) {
    return (1 - X.Part) * linearTexel(L, X.First, Y) +
           X.Part * linearTexel(L, X.Second, Y);
  };
  return {(1 - Y.Part) * Row(Y.First) + Y.Part * Row(Y.Second),
          X.Doubtful || Y.Doubtful};
}

/// \p Footprint: the larger of the distances, in texels of the first level,
/// between neighbouring pixels.
MeshColor sample(const MeshLook &Look, const Texture &T, glm::dvec2 At,
                 double Footprint) {
  const double Level = std::log2(Footprint);
  constexpr double Band = 1e-4;
  const bool NearTurn =
      Look.MagnifiesLinearly != Look.MinifiesLinearly && std::abs(Level) < Band;
  MeshColor Result;
  if (!(Level > 0) || Look.Levels == MeshLook::Mips::None) {
    Result = sampleLevel(
        Look, T.Levels[0],
        Level > 0 ? Look.MinifiesLinearly : Look.MagnifiesLinearly, At);
  } else {
    const auto Last = double(T.Levels.size() - 1);
    const double Wanted = Look.Levels == MeshLook::Mips::Nearest
                              ? std::ceil(Level + 0.5) - 1
                              : Level;
    const double Held = std::min(Wanted, Last), Low = std::floor(Held);
    const auto Number = static_cast<std::size_t>(Low);
    Result = sampleLevel(Look, T.Levels[Number], Look.MinifiesLinearly, At);
    if (Held > Low) {
      const MeshColor Next =
          sampleLevel(Look, T.Levels[Number + 1], Look.MinifiesLinearly, At);
      Result.Rgba += (Held - Low) * (Next.Rgba - Result.Rgba);
      Result.Doubtful |= Next.Doubtful;
    }
    if (Look.Levels == MeshLook::Mips::Nearest)
      Result.Doubtful |= std::abs(Level + 0.5 - std::round(Level + 0.5)) < Band;
  }
  Result.Doubtful |= NearTurn;
  return Result;
}

} // namespace

MeshColor colorOf(const Mesh &M, const Camera<double> &C, std::size_t T,
                  glm::dvec2 At) {
  const Projected P(M, C, T);
  const auto Mixed = [&](const auto &Of, const glm::dvec3 &S, bool ByCorner) {
    const auto Place = [&](std::size_t K) {
      return ByCorner ? 3 * T + K : std::size_t{M.Corners[3 * T + K]};
    };
    return S.x * Of[Place(0)] + S.y * Of[Place(1)] + S.z * Of[Place(2)];
  };
  glm::dvec3 S = P.shares(At.x, At.y);
  S.y = std::clamp(S.y, 0.0, 1.0);
  S.z = std::clamp(S.z, 0.0, 1 - S.y);
  S.x = 1 - S.y - S.z;
  MeshColor Result;
  Result.Rgba = Mixed(M.Colors, S, false);
  const MeshLook &Look = M.Looks[M.LookOf[T]];
  const bool HasPicture = Look.Picture >= 0;
  if (!HasPicture && !M.Light)
    return Result;
  glm::dvec3 Linear(linearOf(Result.Rgba.x), linearOf(Result.Rgba.y),
                    linearOf(Result.Rgba.z));
  if (HasPicture) {
    const Texture &Picture = M.Textures[static_cast<std::size_t>(Look.Picture)];
    const glm::dvec2 Size(Picture.Levels[0].Width, Picture.Levels[0].Height);
    const auto Texel = [&](double X, double Y) {
      return Size * Mixed(M.Coordinates, P.shares(X, Y), true);
    };
    constexpr double Step = 1e-4; // px, for a derivative
    const auto Length = [&](double X, double Y) {
      return glm::length(Texel(At.x + Step * X, At.y + Step * Y) -
                         Texel(At.x - Step * X, At.y - Step * Y)) /
             (2 * Step);
    };
    const MeshColor Sampled =
        sample(Look, Picture, Mixed(M.Coordinates, S, true),
               std::max(Length(1, 0), Length(0, 1)));
    Linear *= glm::dvec3(Sampled.Rgba);
    Result.Rgba.w *= Sampled.Rgba.w;
    Result.Doubtful = Sampled.Doubtful;
  }
  if (M.Light) {
    const auto World = [&](std::size_t K) {
      return M.Positions[M.Corners[3 * T + K]];
    };
    const glm::dvec3 Normal =
        glm::cross(World(1) - World(0), World(2) - World(0));
    // From the camera to the triangle.
    const glm::dvec3 From =
        isParallel(C)
            ? glm::dvec3(C.Rotation[0][2], C.Rotation[1][2], C.Rotation[2][2])
            : World(0) - C.Centre;
    const glm::dvec3 Face =
        glm::normalize(glm::dot(Normal, From) > 0 ? -Normal : Normal);
    glm::dvec3 N = Face;
    if (!M.Normals.empty()) {
      const glm::dvec3 Own = Mixed(M.Normals, S, true);
      if (glm::dot(Own, Own) > 0)
        N = glm::normalize(glm::dot(Own, Face) < 0 ? -Own : Own);
    }
    constexpr double Ambient = 0.2; // the share of light from everywhere
    Linear *= Ambient + (1 - Ambient) * std::max(-glm::dot(N, *M.Light), 0.0);
  }
  for (int K = 0; K < 3; ++K)
    Result.Rgba[K] = storedOf(Linear[K]);
  return Result;
}

/// Sorts the layers of pixel \p I, without those that are hidden. Whether a
/// machine may have another order.
static bool sortLayers(MeshView &V, std::size_t I) {
  std::vector<SeenLayer> &Own = V.Layers[I];
  bool IsDoubtful = false;
  std::erase_if(Own, [&](const SeenLayer &L) {
    IsDoubtful |= std::abs(L.Depth - V.Depths[I]) <= L.Slack + V.Slack[I];
    return L.Depth >= V.Depths[I];
  });
  std::ranges::sort(Own, [](const SeenLayer &A, const SeenLayer &B) {
    return std::pair(A.Depth, A.Triangle) < std::pair(B.Depth, B.Triangle);
  });
  for (std::size_t K = 1; K < Own.size(); ++K)
    IsDoubtful |=
        Own[K].Depth - Own[K - 1].Depth <= Own[K].Slack + Own[K - 1].Slack;
  return IsDoubtful;
}

MeshView viewOf(const Mesh &M, const Camera<double> &C, const Options &O) {
  const double Near = nearLimit(O);
  const std::size_t Pixels =
      static_cast<std::size_t>(C.Width) * static_cast<std::size_t>(C.Height);
  MeshView V;
  V.Depths.assign(Pixels, Infinity);
  V.Triangles.assign(Pixels, -1);
  V.Slack.assign(Pixels, 0);
  V.Doubtful.assign(Pixels, false);
  // The nearest depth, less its slack, at which a pixel may see a triangle that
  // it does not certainly see.
  std::vector<double> Uncertain(Pixels, Infinity);
  V.Layers.resize(Pixels);
  for (std::size_t T = 0; T < M.triangles(); ++T) {
    const Projected P(M, C, T);
    if (!P.hasArea())
      continue;
    const MeshLook &Look = M.Looks[M.LookOf[T]];
    const auto [X0, Y0, X1, Y1] = P.box(C, Near);
    for (int Y = Y0; Y < Y1; ++Y)
      for (int X = X0; X < X1; ++X) {
        const glm::dvec2 At(X + 0.5, Y + 0.5);
        const double Inside = P.inside(At.x, At.y);
        if (Inside < -HalfStep)
          continue;
        const double D = P.depth(At.x, At.y), S = P.slack(At.x, At.y, Near);
        if (!(D > Near - S))
          continue;
        bool IsCertain = Inside > HalfStep && D > Near + S;
        bool IsSeen = Inside >= 0 && D > Near;
        if (Look.Cutoff > 0) {
          const MeshColor Color = colorOf(M, C, T, At);
          IsCertain &= !Color.Doubtful &&
                       std::abs(Color.Rgba.w - Look.Cutoff) > DoubtBand;
          IsSeen &= Color.Rgba.w >= Look.Cutoff;
          if (IsCertain && !IsSeen)
            continue;
        }
        const std::size_t Pixel =
            static_cast<std::size_t>(Y) * static_cast<std::size_t>(C.Width) +
            static_cast<std::size_t>(X);
        const double Before = V.Depths[Pixel];
        if (Look.IsTransparent) {
          if (!IsCertain)
            Uncertain[Pixel] = std::min(Uncertain[Pixel], D - S);
          if (IsSeen)
            V.Layers[Pixel].push_back({D, static_cast<int64_t>(T), S});
          continue;
        }
        if (!IsCertain)
          Uncertain[Pixel] = std::min(Uncertain[Pixel], D - S);
        // Of two in one place either may be seen.
        else if (std::isfinite(Before) &&
                 std::abs(D - Before) <= S + V.Slack[Pixel])
          Uncertain[Pixel] = std::min(Uncertain[Pixel], std::min(D, Before));
        if (!IsSeen || !(D < Before))
          continue;
        V.Depths[Pixel] = D;
        V.Slack[Pixel] = S;
        V.Triangles[Pixel] = static_cast<int64_t>(T);
      }
  }
  for (std::size_t I = 0; I < Pixels; ++I) {
    V.Doubtful[I] =
        Uncertain[I] < Infinity && Uncertain[I] <= V.Depths[I] + V.Slack[I];
    if (sortLayers(V, I))
      V.Doubtful[I] = true;
  }
  return V;
}

Surface<double> surfaceOf(const Mesh &M, const Camera<double> &C,
                          const MeshView &Seen) {
  Surface<double> S;
  S.Depths = Seen.Depths;
  S.Slack = Seen.Slack;
  S.Doubtful = Seen.Doubtful;
  S.Doubtful.resize(Seen.Depths.size());
  S.Colors.resize(Seen.Depths.size());
  const auto ColorIn = [&](std::size_t Pixel, int64_t Triangle) {
    const auto Width = static_cast<std::size_t>(C.Width);
    const std::size_t Column = Pixel % Width, Row = Pixel / Width;
    return colorOf(M, C, static_cast<std::size_t>(Triangle),
                   {double(Column) + 0.5, double(Row) + 0.5});
  };
  for (std::size_t I = 0; I < Seen.Depths.size(); ++I) {
    if (Seen.Triangles[I] < 0)
      continue;
    const MeshColor Color = ColorIn(I, Seen.Triangles[I]);
    S.Colors[I] = glm::dvec3(Color.Rgba);
    if (Color.Doubtful)
      S.Doubtful[I] = true;
  }
  S.Layers.resize(Seen.Layers.size());
  for (std::size_t I = 0; I < Seen.Layers.size(); ++I)
    for (const SeenLayer &L : Seen.Layers[I]) {
      const MeshColor Color = ColorIn(I, L.Triangle);
      S.Layers[I].push_back(
          {L.Depth, glm::dvec3(Color.Rgba), Color.Rgba.w, L.Slack});
      if (Color.Doubtful)
        S.Doubtful[I] = true;
    }
  return S;
}

} // namespace vorion::reference
