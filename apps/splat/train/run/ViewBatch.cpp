#include "train/run/ViewBatch.h"

#include "kernels/batch.cl.h"
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
  Added = 0;
  Losses = {};
  Exposed.clear();
  Posed.clear();
  Sum = {};
}

void ViewBatch::add(const ViewResult *Mine) {
  const unsigned Count = std::min(Processes.size(), Views - Added);
  if (Processes.size() == 1)
    addOwn(*Mine);
  else
    addShared(Mine, Count);
}

void ViewBatch::addGradients(const PlanePair &Of) {
  const bool First = Added == 0;
  if (First)
    Sum = {Launch.allocate("gradients' sums", 4 * GeometrySize),
           Launch.allocate("gradients' sums", 4 * ShSize)};
  const float Scale =
      Added + 1 == Views ? 1.0F / static_cast<float>(Views) : 1.0F;
  const auto Add = [&](const cl::Buffer &To, const cl::Buffer &From,
                       std::size_t Size) {
    const auto Count = static_cast<uint32_t>(Size);
    Launch.run(itemsFor(Count), GroupSize,
               kernels::batch::batch_add{.sums = To,
                                         .gradients = From,
                                         .count = Count,
                                         .first = First ? 1U : 0U,
                                         .scale = Scale});
  };
  Add(Sum.Geometry, Of.Geometry, GeometrySize);
  Add(Sum.Sh, Of.Sh, ShSize);
}

void ViewBatch::addOwn(const ViewResult &Mine) {
  if (Views == 1) {
    Sum = Mine.Back.Gradients; // nothing to add up
  } else {
    Launch.beginStage(Stage::ViewsSum);
    addGradients(Mine.Back.Gradients);
  }
  if (Notes) {
    Launch.beginStage(Stage::DensityControl);
    Density.note(Mine.Back.Seen, Gaussians);
  }
  addTo(Losses, Mine.Loss);
  Exposed.push_back(Mine.ByExposure);
  Posed.push_back(Mine.ByPose);
  ++Added;
}

void ViewBatch::addShared(const ViewResult *Mine, unsigned Count) {
  Launch.beginStage(Stage::ViewsSum);
  // Sized alike in all processes whether or not the device failed in one.
  std::vector<float> Geometry(GeometrySize), Sh(ShSize);
  DensityNotes Of;
  LossValues Loss;
  ExposureMatrix ByExposure{};
  PoseSlope ByPose{};
  const PlanePair Uploaded{
      Launch.allocate("gradients of a view", 4 * GeometrySize),
      Launch.allocate("gradients of a view", 4 * ShSize)};
  for (unsigned From = 0; From < Count; ++From, ++Added) {
    if (Mine && From == Processes.rank()) {
      Launch.read("gradients", Geometry.data(), Mine->Back.Gradients.Geometry,
                  4 * GeometrySize);
      Launch.read("gradients", Sh.data(), Mine->Back.Gradients.Sh, 4 * ShSize);
      if (Notes)
        Of = Density.noteAlone(Mine->Back.Seen, Gaussians);
      Loss = Mine->Loss;
      ByExposure = Mine->ByExposure;
      ByPose = Mine->ByPose;
    }
    const auto Share = [&](auto &Values, std::size_t Size) {
      Values.resize(Size);
      Processes.share(From, Values.data(), 4 * Size);
    };
    Processes.share(From, &Loss, sizeof(Loss));
    Processes.share(From, &ByExposure, sizeof(ByExposure));
    Processes.share(From, &ByPose, sizeof(ByPose));
    Share(Geometry, GeometrySize);
    Share(Sh, ShSize);
    Launch.write("gradients", Uploaded.Geometry, Geometry.data(),
                 4 * GeometrySize);
    Launch.write("gradients", Uploaded.Sh, Sh.data(), 4 * ShSize);
    addGradients(Uploaded);
    addTo(Losses, Loss);
    Exposed.push_back(ByExposure);
    Posed.push_back(ByPose);
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
