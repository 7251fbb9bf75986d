#include "accuracy/Front.h"

#include <algorithm>
#include <gtest/gtest.h>

using namespace vorion::splat;

namespace {

Candidate made(const char *Name, double Db, double Cycles) {
  return {*Setting::parse(Name), {Db}, {Cycles, Cycles, std::nullopt}};
}

const std::vector<Candidate> All{
    made("default", 140, 100),     made("exp=poly4", 120, 100),
    made("exp=poly2", 50, 99),     made("tile=32", 140, 80),
    made("cutoff=0.01", 60, 70),   made("cutoff=0.03", 40, 60),
    made("depth-bits=24", 90, 75), made("alpha-cutoff=8", 39, 65),
};

std::vector<std::string> names(const std::vector<std::size_t> &Places) {
  std::vector<std::string> Names;
  for (const std::size_t I : Places)
    Names.push_back(All[I].Chosen.name());
  return Names;
}

TEST(Front, HasWhatNothingBeats) {
  EXPECT_EQ(names(paretoFront(All, TimeAxis::Cycles)),
            (std::vector<std::string>{"tile=32", "depth-bits=24", "cutoff=0.01",
                                      "cutoff=0.03"}));
  EXPECT_TRUE(paretoFront(All, TimeAxis::Cores).empty());
}

TEST(Front, AFewCyclesAreNoReason) {
  const std::vector<Candidate> Same{made("exp=poly2", 60, 10000),
                                    made("exp=poly4", 120, 10001),
                                    made("exp=exact", 120, 10002)};
  // Of as fast and accurate ones that which changes nothing.
  EXPECT_EQ(paretoFront(Same, TimeAxis::Cycles), std::vector<std::size_t>{2});
  EXPECT_EQ(recommend(Same, TimeAxis::Cycles, 50), 2U);
}

TEST(Front, TheFastestAboveTheFloorIsRecommended) {
  const auto Name = [](double Floor) {
    const auto Best = recommend(All, TimeAxis::Cycles, Floor);
    return Best ? All[*Best].Chosen.name() : std::string("none");
  };
  EXPECT_EQ(Name(0), "cutoff=0.03");
  EXPECT_EQ(Name(50), "cutoff=0.01");
  EXPECT_EQ(Name(90), "depth-bits=24");
  EXPECT_EQ(Name(141), "none");
  EXPECT_EQ(recommend(All, TimeAxis::Cores, 0), std::nullopt);
}

TEST(Front, EveryFloorHasItsRecommendation) {
  const auto Judgements = judged(All, ErrorKind::Psnr, TimeAxis::Cycles);
  const auto Steps = recommendations(Judgements);
  std::size_t Step = 0;
  for (double Floor = 0; Floor <= 150; Floor += 0.5) {
    while (Step < Steps.size() && Floor > Steps[Step].Most)
      ++Step;
    EXPECT_EQ(recommend(Judgements, Floor),
              Step < Steps.size() ? std::optional(Steps[Step].Best)
                                  : std::nullopt)
        << Floor;
  }
  EXPECT_TRUE(
      recommendations(judged(All, ErrorKind::Psnr, TimeAxis::Cores)).empty());
}

TEST(Front, WhatIsRecommendedIsOnIt) {
  // The second takes the first's time and the third's, these two differ.
  const std::vector<Judged> Chain{
      {80, 100.0, 0}, {70, 99.9, 0}, {60, 99.75, 0}};
  EXPECT_EQ(paretoFront(Chain), (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(recommend(Chain, 55), 2U);
  EXPECT_EQ(recommend(Chain, 65), 0U);

  // Times that are nearly the same, and equally accurate settings.
  std::vector<Judged> Many;
  for (unsigned I = 0; I < 300; ++I)
    Many.push_back(
        {40.0 + I * 7919 % 31, 100 + 0.03 * (I * 104729 % 97), I * 31 % 5});
  const auto Front = paretoFront(Many);
  for (double Floor = 39; Floor <= 71; Floor += 0.5) {
    const auto Best = recommend(Many, Floor);
    ASSERT_EQ(Best.has_value(), Floor <= 70) << Floor;
    if (!Best)
      continue;
    EXPECT_TRUE(std::ranges::find(Front, *Best) != Front.end()) << Floor;
    EXPECT_GE(Many[*Best].Merit, Floor);
    for (const Judged &J : Many)
      EXPECT_TRUE(J.Merit < Floor ||
                  *Many[*Best].Time <= *J.Time * (1 + 2 * SameTime))
          << Floor;
  }
}

TEST(Front, TheCoresAreJudgedByTheirOwnPictures) {
  Candidate C = made("cutoff=0.01", 60, 70);
  C.Times[2] = 5;
  C.CoresWorst = Errors{50, 0.5, 0.25, 0.125};
  EXPECT_EQ(judged({C}, ErrorKind::Psnr, TimeAxis::Cores)[0].Merit, 50);
  EXPECT_EQ(judged({C}, ErrorKind::Largest, TimeAxis::Cores)[0].Merit, -0.25);
  EXPECT_EQ(judged({C}, ErrorKind::Psnr, TimeAxis::Cycles)[0].Merit, 60);
}

TEST(Front, SingleKnobsThatTakeNoTimeAreFree) {
  // Of the default's time; cutoffs save, exp=poly2 does by 1 %.
  EXPECT_EQ(names(sameTimeAs(All.front(), All, TimeAxis::Cycles)),
            std::vector<std::string>{"exp=poly4"});
}

TEST(Front, ItsKnobsAreMultiplied) {
  // Four values of four knobs: all combinations of two or more.
  EXPECT_EQ(productOfFronts(allKnobs(), All, 50, 100).size(), 11U);
  // What saves least goes first.
  const auto Product = productOfFronts(allKnobs(), All, 50, 4);
  std::vector<std::string> Names;
  for (const Setting &S : Product)
    Names.push_back(S.name());
  std::sort(Names.begin(), Names.end());
  EXPECT_EQ(Names,
            (std::vector<std::string>{
                "cutoff=0.01,depth-bits=24", "cutoff=0.01,tile=32",
                "cutoff=0.01,tile=32,depth-bits=24", "tile=32,depth-bits=24"}));
  EXPECT_EQ(
      productOfFronts(allKnobs(), All, 50, 3),
      (std::vector<Setting>{*Setting::parse("cutoff=0.01,depth-bits=24")}));
  EXPECT_TRUE(productOfFronts(allKnobs(), All, 200, 100).empty());
}

} // namespace
