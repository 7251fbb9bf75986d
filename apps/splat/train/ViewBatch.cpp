#include "train/ViewBatch.h"

#include "picture/Layout.h"
#include "render/Pipeline.h"

#include <algorithm>

namespace vorion::splat {

namespace {

void addTo(LossValues &Sum, const LossValues &V) {
  Sum.Absolute += V.Absolute;
  Sum.Ssim += V.Ssim;
  Sum.Value += V.Value;
}

} // namespace

void ViewBatch::begin(const DeviceScene &Of, int ShDegree, bool Noting) {
  Gaussians = Of.Count;
  GeometrySize = std::size_t{GEOMETRY_PLANES} * Of.Count;
  ShSize = std::size_t{3} * shCoefficients(ShDegree) * Of.Count;
  Notes = Noting;
  Taken = 0;
  Losses = {};
  Sum = {};
}

void ViewBatch::add(const Given *Mine) {
  const unsigned Count = std::min(Together.size(), Views - Taken);
  if (Together.size() == 1)
    addOwn(*Mine);
  else
    addShared(Mine, Count);
}

void ViewBatch::addGradients(const PlanePair &Of) {
  const bool First = Taken == 0;
  if (First)
    Sum = {L.allocate("gradients' sums", 4 * GeometrySize),
           L.allocate("gradients' sums", 4 * ShSize)};
  const float Scale =
      Taken + 1 == Views ? 1.0F / static_cast<float>(Views) : 1.0F;
  const auto Add = [&](const cl::Buffer &To, const cl::Buffer &From,
                       std::size_t Size) {
    const auto Count = static_cast<uint32_t>(Size);
    L.run(BatchProgram, "batch_add", itemsFor(Count), GroupSize, To, From,
          Count, First ? 1U : 0U, Scale);
  };
  Add(Sum.Geometry, Of.Geometry, GeometrySize);
  Add(Sum.Sh, Of.Sh, ShSize);
}

void ViewBatch::addOwn(const Given &Mine) {
  if (Views == 1) {
    Sum = Mine.Back.Gradients; // nothing to add up
  } else {
    L.beginStage(Stage::ViewsSum);
    addGradients(Mine.Back.Gradients);
  }
  if (Notes) {
    L.beginStage(Stage::DensityControl);
    Density.note(Mine.Back.Seen, Gaussians);
  }
  addTo(Losses, Mine.Loss);
  ++Taken;
}

void ViewBatch::addShared(const Given *Mine, unsigned Count) {
  L.beginStage(Stage::ViewsSum);
  // Sized alike in all processes whether or not the device failed in one.
  std::vector<float> Geometry(GeometrySize), Sh(ShSize);
  DensityNotes Of;
  LossValues Loss;
  const PlanePair Uploaded{L.allocate("gradients of a view", 4 * GeometrySize),
                           L.allocate("gradients of a view", 4 * ShSize)};
  for (unsigned From = 0; From < Count; ++From, ++Taken) {
    if (Mine && From == Together.rank()) {
      L.read("gradients", Geometry.data(), Mine->Back.Gradients.Geometry,
             4 * GeometrySize);
      L.read("gradients", Sh.data(), Mine->Back.Gradients.Sh, 4 * ShSize);
      if (Notes)
        Of = Density.noteAlone(Mine->Back.Seen, Gaussians);
      Loss = Mine->Loss;
    }
    const auto Share = [&](auto &Values, std::size_t Size) {
      Values.resize(Size);
      Together.share(From, Values.data(), 4 * Size);
    };
    Together.share(From, &Loss, sizeof(Loss));
    Share(Geometry, GeometrySize);
    Share(Sh, ShSize);
    L.write("gradients", Uploaded.Geometry, Geometry.data(), 4 * GeometrySize);
    L.write("gradients", Uploaded.Sh, Sh.data(), 4 * ShSize);
    addGradients(Uploaded);
    addTo(Losses, Loss);
    if (Notes) {
      Share(Of.GradientSums, Gaussians);
      Share(Of.Views, Gaussians);
      Share(Of.Radii, Gaussians);
      Density.merge(Of);
    }
  }
}

LossValues ViewBatch::loss() const {
  return {Losses.Absolute / Views, Losses.Ssim / Views, Losses.Value / Views};
}

} // namespace vorion::splat
