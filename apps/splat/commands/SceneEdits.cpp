#include "commands/SceneEdits.h"

#include "commands/Usage.h"
#include "scene/Edit.h"
#include "scene/MortonOrder.h"
#include "scene/Selection.h"
#include "vorion/support/CommandLine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace vorion::splat {
namespace {

Expected<Success> check(const SceneEdits &E) {
  for (const auto &[Name, Values] : {std::pair("--translate", &E.Translate),
                                     {"--rotate", &E.Rotate},
                                     {"--crop-box", &E.Box},
                                     {"--crop-sphere", &E.Sphere}})
    if (!std::ranges::all_of(*Values,
                             [](double V) { return std::isfinite(V); }))
      return usage(fmt::format("{}: expected finite numbers", Name));
  if (E.Scale && !(*E.Scale > 0 && std::isfinite(*E.Scale)))
    return usage(
        fmt::format("--scale {}: expected a number above 0", *E.Scale));
  if (!E.Box.empty())
    for (std::size_t A = 0; A < 3; ++A)
      if (!(E.Box[A] < E.Box[A + 3]))
        return usage(
            fmt::format("--crop-box: {} to {} is empty, expected "
                        "x0,y0,z0,x1,y1,z1 with x0 < x1, y0 < y1 and z0 < z1",
                        E.Box[A], E.Box[A + 3]));
  if (!E.Sphere.empty() && !(E.Sphere[3] > 0))
    return usage(
        fmt::format("--crop-sphere: a radius of {}, expected a radius above 0",
                    E.Sphere[3]));
  return Success{};
}

/// Leaves out the Gaussians that are \p Selected, or the others, and says so in
/// \p Said.
Expected<Success> leaveOut(Scene &S, const char *Name, const std::string &What,
                           std::vector<LeftOut> &Said,
                           const Selection &Selected, bool IfSelected) {
  const std::size_t Count = S.size(), Gone = keepOnly(S, [&](std::size_t I) {
                                        return Selected[I] != IfSelected;
                                      });
  Said.push_back(
      {fmt::format("dropped {} of {} Gaussians {}", Gone, Count, What), Name,
       Gone});
  if (S.size() == 0)
    return Error{
        "",
        fmt::format("all {} Gaussians are {}, expected at least one to remain",
                    Count, What)};
  return Success{};
}

template <std::size_t Count>
std::array<double, Count> firstOf(const std::vector<double> &Values) {
  std::array<double, Count> Of{};
  std::copy_n(Values.begin(), Count, Of.begin());
  return Of;
}

Similarity moveOf(const SceneEdits &E) {
  Similarity By;
  By.Scale = E.Scale.value_or(1);
  if (!E.Rotate.empty())
    By.Rotation = rotationOf({E.Rotate[0], E.Rotate[1], E.Rotate[2]});
  if (!E.Translate.empty())
    By.Translation = {E.Translate[0], E.Translate[1], E.Translate[2]};
  return By;
}

} // namespace

void addEditOptions(CLI::App &App, SceneEdits &E) {
  constexpr const char *Group = "Edits, applied in this order";
  const auto Numbers = [&](const char *Name, std::vector<double> &To, int Count,
                           const char *Text, const char *What) {
    App.add_option(Name, To, What)
        ->delimiter(',')
        ->expected(Count)
        ->option_text(Text)
        ->group(Group);
  };
  App.add_option("--scale", E.Scale, "Multiply all lengths")
      ->option_text("S")
      ->group(Group);
  Numbers("--rotate", E.Rotate, 3, "X,Y,Z",
          "Rotate by degrees about x, then y, then z, including spherical "
          "harmonics");
  Numbers("--translate", E.Translate, 3, "X,Y,Z", "Move");
  App.add_option("--drop-faint", E.Faint,
                 "Drop Gaussians with an opacity below A")
      ->option_text("A")
      ->check(isBetween(0.0, 1.0))
      ->group(Group);
  App.add_option("--drop-large", E.Large,
                 "Drop Gaussians with a standard deviation above D, in units "
                 "of the scene")
      ->option_text("D")
      ->check(isBetween(0.0, 1e30))
      ->group(Group);
  Numbers("--crop-box", E.Box, 6, "X0,Y0,Z0,X1,Y1,Z1",
          "Keep Gaussians whose centre is inside the box between two corners");
  Numbers("--crop-sphere", E.Sphere, 4, "X,Y,Z,R",
          "Keep Gaussians whose centre is within R of a point");
  App.add_option("--sh-degree", E.Degree,
                 "Keep spherical harmonics up to degree N")
      ->option_text("N")
      ->check(isBetween(0, MaxShDegree))
      ->group(Group);
  App.add_flag(
         "--morton-order", E.MortonOrder,
         "Sort Gaussians along a Morton curve (Z-order curve) of their means")
      ->group(Group);
}

Expected<SceneChanges> editScene(Scene &S, const SceneEdits &E) {
  if (auto Checked = check(E); !Checked)
    return Checked.error();
  SceneChanges Done;
  std::vector<LeftOut> &Said = Done.Left;
  transform(S, moveOf(E));
  if (auto Finite = checkFinite("", S); !Finite)
    return Error{"", "the transformed scene exceeds the range of floats, "
                     "expected a smaller --scale or --translate"};
  if (E.Faint)
    if (auto Kept = leaveOut(S, "faint",
                             fmt::format("with an opacity below {}", *E.Faint),
                             Said, fainterThan(S, *E.Faint), true);
        !Kept)
      return Kept.error();
  if (E.Large)
    if (auto Kept = leaveOut(
            S, "large",
            fmt::format("with a standard deviation above {}", *E.Large), Said,
            largerThan(S, *E.Large), true);
        !Kept)
      return Kept.error();
  if (!E.Box.empty())
    if (auto Kept = leaveOut(S, "box", "outside the box", Said,
                             inBox(S, firstOf<6>(E.Box)), false);
        !Kept)
      return Kept.error();
  if (!E.Sphere.empty())
    if (auto Kept = leaveOut(S, "sphere", "outside the sphere", Said,
                             inSphere(S, firstOf<4>(E.Sphere)), false);
        !Kept)
      return Kept.error();
  if (E.Degree && *E.Degree < S.ShDegree) {
    Said.push_back(
        {fmt::format("dropped spherical harmonics above degree {}", *E.Degree),
         "harmonics", 0});
    setShDegree(S, *E.Degree);
  }
  if (E.MortonOrder)
    Done.Reordered = putInMortonOrder(S);
  return Done;
}

Expected<Success> moveMesh(Mesh &M, const SceneEdits &E) {
  transform(M, moveOf(E));
  if (!std::ranges::all_of(M.Positions,
                           [](float V) { return std::isfinite(V); }))
    return Error{M.file(), "the transformed mesh exceeds the range of floats, "
                           "expected a smaller --scale or --translate"};
  return Success{};
}

} // namespace vorion::splat
