// "RAWS", the number of Gaussians in 32 bits, then for each mean, log scales,
// quaternion, opacity logit and colour as the scene has them. Degree 0.
#include "scene/formats/Formats.h"

#include <fmt/format.h>

namespace vorion::splat {

bool isRaws(Bytes File) { return asText(File).starts_with("RAWS"); }

Expected<SceneFile> parseRaws(const std::string &Where, Bytes File,
                              const ReadOptions & /*Options*/) {
  constexpr std::size_t Header = 8, Record = 14 * sizeof(float);
  const std::size_t Count = File.size() < Header ? 0 : load<uint32_t>(File, 4);
  if (File.size() < Header || (File.size() - Header) % Record != 0 ||
      (File.size() - Header) / Record != Count)
    return Error{Where, fmt::format("{} bytes, expected 8 and {} for each "
                                    "Gaussian that the header counts",
                                    File.size(), Record)};
  SceneFile Result;
  Result.Format = SceneFormat::Raws;
  Scene &S = Result.Gaussians = Scene::sized(Count, 0);
  for (std::size_t I = 0; I < Count; ++I) {
    std::size_t At = Header + I * Record;
    const auto Take = [&](float *To, std::size_t Values) {
      for (std::size_t K = 0; K < Values; ++K, At += sizeof(float))
        To[K] = load<float>(File, At);
    };
    Take(&S.Means[3 * I], 3);
    Take(&S.LogScales[3 * I], 3);
    Take(&S.Quats[4 * I], 4);
    Take(&S.OpacityLogits[I], 1);
    Take(&S.Sh[3 * I], 3);
  }
  return Result;
}

} // namespace vorion::splat
