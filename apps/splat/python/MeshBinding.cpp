#include "python/Arrays.h"
#include "python/Bindings.h"

#include "commands/MeshArguments.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <optional>
#include <pybind11/stl.h>

namespace vorion::splat::python {

namespace py = pybind11;

namespace {

constexpr auto Dense = py::array::c_style | py::array::forcecast;

template <typename T, int Flags>
std::vector<T> listOf(const std::optional<py::array_t<T, Flags>> &A) {
  return A ? std::vector<T>(A->data(), A->data() + A->size())
           : std::vector<T>();
}

/// Of arrays that mesh.py has checked: \p Coordinates and \p Normals of
/// corners,
/// \p Picture of bytes r, g, b, a.
std::shared_ptr<Mesh>
made(const FloatArray &Vertices, const FloatArray &Colors,
     const py::array_t<uint32_t, Dense> &Triangles,
     const std::optional<FloatArray> &Normals,
     const std::optional<FloatArray> &Coordinates,
     const std::optional<py::array_t<uint8_t, Dense>> &Picture, int Alpha,
     float Cutoff) {
  auto M = std::make_shared<Mesh>();
  M->Positions = listOf(std::optional(Vertices));
  M->Colors = listOf(std::optional(Colors));
  M->Corners = listOf(std::optional(Triangles));
  M->Normals = listOf(Normals);
  M->TextureCoordinates = listOf(Coordinates);
  M->MaterialOf.resize(M->triangles());
  Material &Look = M->Materials.emplace_back();
  Look.Alpha = static_cast<AlphaMode>(Alpha);
  Look.Cutoff = Cutoff;
  if (!Picture)
    return M;
  const auto Height = static_cast<std::size_t>(Picture->shape(0)),
             Width = static_cast<std::size_t>(Picture->shape(1));
  std::vector<uint32_t> Texels(Width * Height);
  std::memcpy(Texels.data(), Picture->data(), 4 * Texels.size());
  Look.Picture = 0;
  M->Textures.push_back(
      valueOf(makeTexture("texture", Width, Height, std::move(Texels))));
  return M;
}

std::shared_ptr<Mesh> read(const std::string &Path) {
  const py::gil_scoped_release Released;
  return std::make_shared<Mesh>(valueOf(loadMesh(Path)));
}

} // namespace

void addMesh(py::module_ &M) {
  py::class_<Mesh, std::shared_ptr<Mesh>>(M, "Mesh")
      .def_static("made", made)
      .def_static("read", read)
      .def_property_readonly("size",
                             [](const Mesh &Of) { return Of.triangles(); })
      .def_property_readonly("vertices",
                             [](const Mesh &Of) {
                               return arrayOf(Of.Positions, {Of.vertices(), 3});
                             })
      .def_property_readonly(
          "colors",
          [](const Mesh &Of) { return arrayOf(Of.Colors, {Of.vertices(), 4}); })
      .def_property_readonly("triangles", [](const Mesh &Of) {
        return arrayOf(
            std::vector<int32_t>(Of.Corners.begin(), Of.Corners.end()),
            {Of.triangles(), 3});
      });
}

} // namespace vorion::splat::python
