#include "python/Arrays.h"
#include "python/Bindings.h"

#include "commands/OutputFile.h"
#include "commands/SceneArguments.h"
#include "scene/SceneWriter.h"
#include "vorion/support/Outputs.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

namespace vorion::splat::python {

namespace py = pybind11;

namespace {

/// \p Given are options and the file.
SceneFile read(Words Given) {
  const py::gil_scoped_release Released;
  SceneArguments A;
  parse(std::move(Given), [&](CLI::App &App) { addSceneOptions(App, A); });
  return valueOf(loadScene(A));
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
  addView(C, "means", &Scene::Means, 3);
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
