#include "train/run/ViewBatch.h"

#include "kernels/batch.cl.h"
#include "picture/Layout.h"
#include "render/Pipeline.h"

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

void ViewBatch::add(const ViewResult &View) {
  if (Views == 1) {
    Sum = View.Back.Gradients; // nothing to add up
  } else {
    Launch.beginStage(Stage::ViewsSum);
    addGradients(View.Back.Gradients);
  }
  if (Notes) {
    Launch.beginStage(Stage::DensityControl);
    Density.note(View.Back.Seen, Gaussians);
  }
  addTo(Losses, View.Loss);
  Exposed.push_back(View.ByExposure);
  Posed.push_back(View.ByPose);
  ++Added;
}

LossValues ViewBatch::loss() const {
  return {Losses.Absolute / Views, Losses.Ssim / Views, Losses.Value / Views};
}

} // namespace vorion::splat
