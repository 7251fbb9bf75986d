#include "HardCase.h"
#include "TrainingCase.h"

namespace vorion::test {

std::vector<HardCase> catalogue() {
  std::vector<HardCase> Cases;
  addShapes(Cases);
  addOpacities(Cases);
  addOrders(Cases);
  addViews(Cases);
  addPlaces(Cases);
  addLists(Cases);
  addLenses(Cases);
  return Cases;
}

std::vector<TrainingCase> trainingCases() {
  std::vector<TrainingCase> Cases;
  addRayOrders(Cases);
  addRays(Cases);
  addMeshes(Cases);
  addGradients(Cases);
  addMethodGradients(Cases);
  addSteps(Cases);
  addMethods(Cases);
  addDensity(Cases);
  return Cases;
}

std::vector<CaseElsewhere> casesElsewhere() {
  const std::string Units = "isasim/raster/HardCases_test.cpp";
  return {
      {"lists of 0, 1, 16, 17 and 2^20 entries",
       "the scalar loop's bits; 2^20 layers within 1e-6 of their limit", Units},
      {"unsorted lists, duplicate entries",
       "blended in the list's order, as often as they stand there", Units},
      {"box edges on pixel centres +-1 ulp, up to coordinate 65535.5",
       "the pixels whose centres satisfy the comparison in fp32", Units},
      {"radius beyond an int, infinite boxes", "every pixel of the tile",
       Units},
      {"64 layers of 0.99 without a cut-off",
       "the scalar loop's bits, T within 1e-5 of 0.01^n in relation", Units},
      {"T above 1 on the way back, with every approximate reciprocal",
       "the scalar loop's bits, T within the unit's error to the power of the "
       "layers",
       "isasim/raster/HardBackward_test.cpp"},
      {"NaN in a record", "status VR_NAN, no pixel written",
       "isasim/raster/Rasterizer_test.cpp"},
      {"NaN or infinity without a meaning in a scene file, every parameter",
       "one line that names the Gaussian, exit code 3",
       "test/numerics/not-finite.test"},
      {"NaN or infinity in a camera, cut-off, background or dilation",
       "one line, exit code 2 or 3", "test/numerics/not-finite.test"},
      {"scenes and captures in map coordinates, where fp32 has steps of 1/64 "
       "to 1/2",
       "pictures within 100 dB of those at home, PSNR of training within 0.01 "
       "dB; both are computed from an origin nearby",
       "test/render/far-coordinates.test"},
      {"no Gaussian at all", "one line, exit code 3",
       "test/numerics/not-finite.test"},
      {"pairs beyond memory, and beyond 2^32",
       "one line that says how much, exit code 5",
       "test/numerics/not-finite.test"},
      {"orders that another view, or each pixel's own ray, turns round",
       "counted, with the picture's PSNR; the view itself turns none",
       "test/render/analyze.test"},
      {"a picture of which no pixel counts", "one line that names its mask",
       "apps/splat/train/data/TrainingSet_test.cpp"},
      {"random backgrounds of a run that goes on", "the same bits",
       "apps/splat/train/run/Trainer_test.cpp"}};
}

} // namespace vorion::test
