#include "python/Arrays.h"
#include "python/Bindings.h"

#include "commands/OutputFile.h"
#include "commands/SceneArguments.h"
#include "scene/LocalFrame.h"
#include "scene/SceneWriter.h"
#include "vorion/support/Outputs.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

namespace vorion::splat::python {

namespace py = pybind11;

namespace {

/// Rests that no picture shows would be wrong once Python changes the means.
void dropIdleRests(Scene &S) {
  if (!needsDoubles(S))
    S.MeanRests.clear();
}

/// Where fp32 holds the means, an array that shares their memory; otherwise a
/// copy in doubles, which cannot be written.
py::array means(const py::object &Self) {
  Scene &S = Self.cast<SceneFile &>().Gaussians;
  const Shape Sizes{S.size(), 3};
  if (S.MeanRests.empty())
    return viewOf(S.Means, Sizes, Self);
  std::vector<double> World(S.Means.size());
  for (std::size_t I = 0; I < World.size(); ++I)
    World[I] = S.mean(I);
  py::array A = arrayOf(std::move(World), Sizes);
  A.attr("setflags")(py::arg("write") = false);
  return A;
}

/// \p Values: as many as there are.
void setMeans(SceneFile &F,
              const py::array_t<double, py::array::c_style |
                                            py::array::forcecast> &Values) {
  for (std::size_t I = 0; I < F.Gaussians.Means.size(); ++I)
    F.Gaussians.setMean(I, Values.data()[I]);
  dropIdleRests(F.Gaussians);
}

/// \p Given are options and the file.
SceneFile read(Words Given) {
  const py::gil_scoped_release Released;
  SceneArguments A;
  parse(std::move(Given), [&](CLI::App &App) { addSceneOptions(App, A); });
  SceneFile F = valueOf(loadScene(A));
  dropIdleRests(F.Gaussians);
  return F;
}

/// What the file does not have of the scene, by name.
py::dict write(const SceneFile &F, const std::string &Path) {
  const auto Written = [&] {
    const py::gil_scoped_release Released;
    valueOf(checkEnding("path", Path, writtenEndings()));
    valueOf(claimOutputs({{"path", Path}}));
    valueOf(checkFinite("the scene", F.Gaussians));
    return valueOf(writeScene(Path, F.Gaussians, F.DrawnAs));
  }();
  py::dict Lost;
  for (const auto &[Name, Most] : byName(Written.Lost))
    Lost[py::str(Name)] = Most;
  Lost["sh_degree"] = F.Gaussians.ShDegree - Written.ShDegree;
  Lost["drawing"] = !Written.KeepsDrawing;
  return Lost;
}

/// Zeros for the package to fill in.
SceneFile sized(std::size_t Count, int ShDegree, bool Antialiased,
                std::optional<double> Dilation) {
  if (Dilation && !isDilation(*Dilation))
    throw Failed(Error{
        "",
        fmt::format("dilation {}: expected {}", *Dilation, ExpectedDilation),
        ExitCode::Usage});
  SceneFile F;
  F.Gaussians = Scene::sized(Count, ShDegree);
  F.DrawnAs = {Antialiased, Dilation, "the arguments of vorion.Scene"};
  return F;
}

/// A property whose array shares the memory of \p Member, \p Each values a
/// Gaussian; they are one axis unless \p Each is 1.
template <typename Class>
void addView(Class &C, const char *Name, std::vector<float> Scene::*Member,
             std::size_t Each) {
  C.def_property_readonly(Name, [Member, Each](const py::object &Self) {
    Scene &S = Self.cast<SceneFile &>().Gaussians;
    Shape Sizes{S.size()};
    if (Each != 1)
      Sizes.push_back(Each);
    return viewOf(S.*Member, Sizes, Self);
  });
}

} // namespace

void addScene(py::module_ &M) {
  py::class_<SceneFile> C(M, "Scene");
  C.def_static("read", read);
  C.def("write", write);
  C.def_static("sized", sized);
  C.def_property_readonly("means", means);
  C.def("set_means", setMeans);
  addView(C, "log_scales", &Scene::LogScales, 3);
  addView(C, "quats", &Scene::Quats, 4);
  addView(C, "opacity_logits", &Scene::OpacityLogits, 1);
  C.def_property_readonly("sh", [](const py::object &Self) {
    Scene &S = Self.cast<SceneFile &>().Gaussians;
    return viewOf(S.Sh, {S.size(), S.coefficients(), 3}, Self);
  });
  C.def_property_readonly(
      "size", [](const SceneFile &F) { return F.Gaussians.size(); });
  C.def_property_readonly(
      "sh_degree", [](const SceneFile &F) { return F.Gaussians.ShDegree; });
  C.def_property_readonly(
      "format", [](const SceneFile &F) { return std::string(name(F.Format)); });
  C.def_property_readonly(
      "antialiased", [](const SceneFile &F) { return F.DrawnAs.Antialiased; });
  C.def_property_readonly(
      "dilation", [](const SceneFile &F) { return F.DrawnAs.Dilation; });
}

} // namespace vorion::splat::python
