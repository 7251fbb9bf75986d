#include "python/Bindings.h"

#include "cameras/GoodView.h"
#include "commands/CameraArguments.h"
#include "io/Cameras.h"
#include "picture/Options.h"
#include "vorion/support/Outputs.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <pybind11/stl.h>

namespace vorion::splat::python {

namespace py = pybind11;

namespace {

using Row = std::array<double, 3>;

/// \p Rotation and \p Position as in Camera; the error that is thrown names the
/// argument of vorion.Camera.
Camera made(std::string Name, int Width, int Height,
            const std::array<double, 4> &Intrinsics,
            const std::array<Row, 3> &Rotation, const Row &Position) {
  const auto Refuse = [](std::string What) {
    throw Failed({"", std::move(What), ExitCode::Usage});
  };
  for (const int Side : {Width, Height})
    if (Side < 1 || Side > MaxImageSize)
      Refuse(fmt::format("a picture of {}x{} pixels, expected sides of 1 to {}",
                         Width, Height, MaxImageSize));
  for (const double Number : Intrinsics)
    if (!std::isfinite(Number))
      Refuse("intrinsics: expected finite numbers");
  const auto [Fx, Fy, Cx, Cy] = Intrinsics;
  if (!(Fx > 0 && Fy > 0))
    Refuse(fmt::format("focal lengths {} and {}, expected positive numbers of "
                       "pixels",
                       Fx, Fy));
  for (const double Number : Position)
    if (!std::isfinite(Number))
      Refuse("world_to_camera: expected finite numbers");
  if (!isRotation(Rotation))
    Refuse("world_to_camera is not a rotation with a translation, expected "
           "orthonormal axes with determinant +1");
  Camera C;
  C.Name = std::move(Name);
  C.Width = Width;
  C.Height = Height;
  C.Rotation = Rotation;
  C.Position = Position;
  C.Fx = Fx;
  C.Fy = Fy;
  C.Cx = Cx;
  C.Cy = Cy;
  return C;
}

} // namespace

/// What no view can be found of.
static void checkScene(const SceneFile &S) {
  valueOf(checkFinite("the scene", S.Gaussians));
  if (S.Gaussians.size() == 0)
    throw Failed({"", "no Gaussians, expected at least one"});
}

/// The automatic view of \p S.
static Camera found(const SceneFile &S, int Width, int Height) {
  if (std::min(Width, Height) < 1 || std::max(Width, Height) > MaxImageSize)
    throw Failed({"",
                  fmt::format("a picture of {}x{} pixels, expected sides of 1 "
                              "to {}",
                              Width, Height, MaxImageSize),
                  ExitCode::Usage});
  checkScene(S);
  return goodView(S.Gaussians, focusOf(S), Width, Height,
                  nearLimit(Rules::Inria));
}

/// Those that the options of splat render in \p Given choose.
static std::vector<Camera> chosen(const SceneFile &S, Words Given) {
  CameraArguments A;
  parse(std::move(Given), [&](CLI::App &App) {
    addCameraOptions(App, A, /*Several=*/true);
    App.add_option("--view", A.Views)->allow_extra_args(false);
  });
  checkScene(S);
  const py::gil_scoped_release Released;
  return valueOf(chooseCameras(A, S));
}

static void write(const std::string &Path, const std::vector<Camera> &Cameras) {
  valueOf(claimOutputs({{"path", Path}}));
  valueOf(writeCameras(Path, Cameras));
}

void addCamera(py::module_ &M) {
  M.def("cameras", &chosen);
  M.def("write_cameras", &write);
  py::class_<Camera>(M, "Camera")
      .def(py::init(&made))
      .def_static("found", &found)
      .def_static("read",
                  [](const std::string &Path, const std::string &View) {
                    return valueOf(readCamera(Path, View));
                  })
      .def_static(
          "read_all",
          [](const std::string &Path) { return valueOf(readCameras(Path)); })
      .def_readonly("name", &Camera::Name)
      .def_property_readonly(
          "model", [](const Camera &C) { return C.Optics.Model->Name; })
      .def_readonly("width", &Camera::Width)
      .def_readonly("height", &Camera::Height)
      .def_readonly("rotation", &Camera::Rotation)
      .def_readonly("position", &Camera::Position)
      .def_property_readonly("intrinsics", [](const Camera &C) {
        return std::array{C.Fx, C.Fy, C.Cx, C.Cy};
      });
}

} // namespace vorion::splat::python
