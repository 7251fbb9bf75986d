#include "scene/SceneFile.h"
#include "scene/testing/Compare.h"
#include "scene/testing/SceneWriters.h"

#include <nlohmann/json.hpp>

using namespace vorion;
using namespace vorion::splat;
using namespace vorion::splat::testing;

namespace {

using Json = nlohmann::json;

SceneFile parsed(const std::string &Content, int Version = 2) {
  SceneFile Read = parsedAs(SceneFormat::Sog, Content);
  EXPECT_EQ(Read.Version, Version);
  return Read;
}

TEST(Sog, RoundTripsWithinHalfAStepAtEveryDegree) {
  for (int Degree = 0; Degree <= MaxShDegree; ++Degree) {
    const Scene S = randomScene(100, Degree, 7);
    const Scene Read = parsed(zipOf(sogOf(S))).Gaussians;
    // 16 bits of ln(|x| + 1) on each side of zero, at most ln(51); a step there
    // is |x| + 1 times as long in x.
    const double LogStep = 2 * std::log(51.0) / 65535;
    ASSERT_EQ(Read.Means.size(), S.Means.size());
    for (std::size_t I = 0; I < S.Means.size(); ++I)
      EXPECT_NEAR(Read.Means[I], S.Means[I],
                  (std::abs(S.Means[I]) + 1) * LogStep / 2 * 1.001 + 1e-5);
    const auto D = differencesOf(Read, S);
    EXPECT_LE(D.LogScale, 8.0 / 255 / 2 + 1e-6);
    EXPECT_LE(D.Opacity, 0.5 / 255 + 1e-6);
    EXPECT_LE(D.Color, 1.8 / 255 / 2 + 1e-6);
    EXPECT_LE(D.Harmonics, 1.8 / 255 / 2 + 1e-6);
    // Half a step of three components; the fourth takes at most their sum.
    EXPECT_LE(D.Rotation, 3 * std::sqrt(2) / 255 / 2 + 1e-6);
    EXPECT_GT(D.Position, 0);
  }
}

TEST(Sog, Version1HasEvenStepsAndNoVersion) {
  for (int Degree = 0; Degree <= MaxShDegree; ++Degree) {
    const Scene S = randomScene(100, Degree, 7);
    const SceneFile First = parsed(zipOf(sogOf(S, 1)), 1),
                    Second = parsed(zipOf(sogOf(S)));
    const auto D = differencesOf(First.Gaussians, Second.Gaussians);
    EXPECT_EQ(D.Position + D.Rotation, 0);
    EXPECT_LE(D.LogScale + D.Color + D.Harmonics, 1e-5); // the books' roundings
    // Logits from -5 to 5 in 255 steps; half of one is at most a quarter of
    // it in opacity.
    EXPECT_LE(differencesOf(First.Gaussians, S).Opacity, 10.0 / 255 / 8 + 1e-6);
  }
}

TEST(Sog, TakesTheFilesThatItsDescriptionNames) {
  const Scene S = randomScene(5, 1, 3);
  Folder Files = sogOf(S);
  nlohmann::json Meta = nlohmann::json::parse(Files["meta.json"]);
  Files["other.bin"] = Files["quats.webp"];
  Files.erase("quats.webp");
  Meta["quats"]["files"][0] = "other.bin";
  Meta["antialias"] = true;
  Files["meta.json"] = Meta.dump();
  const SceneFile Read = parsed(zipOf(Files));
  EXPECT_TRUE(Read.DrawnAs.Antialiased);
  EXPECT_EQ(Read.DrawnAs.Source, "antialias true");
  EXPECT_LE(differencesOf(Read.Gaussians, S).Rotation, 0.01);
}

TEST(Sog, ANullAtTheStartOfACodebookIsOneStepBelowTheNext) {
  const Scene S = randomScene(60, 1, 4);
  Folder Files = sogOf(S);
  const Scene Whole = parsed(zipOf(Files)).Gaussians;
  Json Meta = Json::parse(Files["meta.json"]);
  double MeanStep = 0;
  for (const char *Group : {"scales", "sh0", "shN"}) {
    Json &Book = Meta[Group]["codebook"];
    MeanStep = (Book[255].get<double>() - Book[1].get<double>()) / 254;
    Book[0] = nullptr;
  }
  Files["meta.json"] = Meta.dump();
  const Scene Read = parsed(zipOf(Files)).Gaussians;
  EXPECT_NE(Read.LogScales, Whole.LogScales);
  EXPECT_LE(differencesOf(Read, Whole).LogScale, 2 * std::abs(MeanStep) + 0.1);
}

TEST(Sog, ALargePaletteContinuesInTheNextRow) {
  // The writer gives each Gaussian an entry: 64 a row.
  const Scene S = randomScene(130, 3, 4);
  const auto D = differencesOf(parsed(zipOf(sogOf(S))).Gaussians, S);
  EXPECT_LE(D.Harmonics, 1.8 / 255 / 2 + 1e-6);
}

} // namespace
