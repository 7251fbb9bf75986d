#include "machine/MachineTexts.h"

#include <fmt/ranges.h>
#include <gtest/gtest.h>

using namespace vorion;
using namespace vorion::isasim;

namespace {

class EveryMachine : public ::testing::TestWithParam<size_t> {
protected:
  std::string name() const { return std::string(machineNames()[GetParam()]); }
};
INSTANTIATE_TEST_SUITE_P(, EveryMachine,
                         ::testing::Range<size_t>(0, machineNames().size()),
                         [](const auto &Info) {
                           std::string Name(machineNames()[Info.param]);
                           std::erase(Name, '-');
                           return Name;
                         });

TEST_P(EveryMachine, IsGoodAndIsCalledByItsName) {
  const Config &C = namedMachine(GetParam());
  EXPECT_TRUE(validate(C));
  EXPECT_EQ(nameOf(C).Name, name());
  EXPECT_TRUE(nameOf(C).Changes.empty());
}

TEST_P(EveryMachine, IsChosenByTheKeyAndByTheName) {
  Config ByKey;
  ASSERT_TRUE(setValues(ByKey, "machine=" + name()));
  const auto Found = findMachine(name());
  ASSERT_TRUE(Found) << Found.error().What;
  const auto ByName = parseConfig(Found->Json, Found->Where);
  ASSERT_TRUE(ByName) << ByName.error().What;
  EXPECT_EQ(toJson(ByKey), toJson(*ByName));
  EXPECT_EQ(toJson(ByKey), toJson(namedMachine(GetParam())));
}

TEST_P(EveryMachine, ItsFileSaysAllThatMachinesDifferIn) {
  for (size_t Other = 0; Other != machineNames().size(); ++Other) {
    Config C = namedMachine(Other);
    ASSERT_TRUE(changeConfig(C, machineText(name()), name()));
    EXPECT_EQ(toJson(C), toJson(namedMachine(GetParam())));
  }
}

TEST_P(EveryMachine, ItsChangesMakeTheOther) {
  Config C = namedMachine(GetParam());
  ASSERT_TRUE(setValues(C, "timing.core.preset=vortex-2025,timing.l2.ways=5,"
                           "timing.core.join_cycles=7,"
                           "timing.dram.address_map=xor"));
  const MachineName Name = nameOf(C);
  EXPECT_TRUE(Name.Name.ends_with(" with changes")) << Name.Name;
  EXPECT_EQ(Name.Changes.size(), 4U)
      << "a preset is one change: " << fmt::format("{}", Name.Changes);
  Config Again;
  const std::string Base = Name.Name.substr(0, Name.Name.find(' '));
  ASSERT_TRUE(setValues(
      Again, fmt::format("machine={},{}", Base, fmt::join(Name.Changes, ","))));
  Again.Timing.ClockMhz = C.Timing.ClockMhz;
  EXPECT_EQ(toJson(Again), toJson(C));
}

TEST(NamedMachines, TheFirstIsTheDefault) {
  EXPECT_EQ(toJson(defaultMachine()), toJson(namedMachine(0)));
  EXPECT_EQ(nameOf(defaultMachine()).Name, "prototype");
  const auto Nothing = parseConfig("{}", "");
  ASSERT_TRUE(Nothing);
  EXPECT_EQ(toJson(*Nothing), toJson(defaultMachine()));
}

TEST(NamedMachines, ThePlainOneIsOnTheChip) {
  EXPECT_EQ(nameOf(Config()).Name, "prototype-on-chip");
}

TEST(NamedMachines, AMachineLeavesWhatBelongsToTheRun) {
  Config C;
  ASSERT_TRUE(setValues(C, "host_threads=3,quantum=77,max_instructions=9,"
                           "timing.enabled=1,timing.l2.ways=4"));
  ASSERT_TRUE(setValues(C, "machine=scaled"));
  EXPECT_EQ(C.HostThreads, 3U);
  EXPECT_EQ(C.Quantum, 77U);
  EXPECT_EQ(C.MaxInstructions, 9U);
  EXPECT_TRUE(C.Timing.Enabled);
  EXPECT_EQ(C.Timing.L2.Ways, 8U);
  EXPECT_EQ(nameOf(C).Name, "scaled") << "these make no other machine";
  C.Timing.ClockMhz = 100;
  EXPECT_EQ(nameOf(C).Name, "scaled") << "nor does the clock";
}

TEST(NamedMachines, AMachineUndoesNothingThatStandsBesideIt) {
  Config C, InOrder;
  ASSERT_TRUE(setValues(C, "clusters=2,timing.core.preset=forwarding,"
                           "timing.l2.ways=4,clusters=3,machine=scaled"));
  EXPECT_EQ(C.Clusters, 3U) << "the last one of a key";
  ASSERT_TRUE(setValues(InOrder, "machine=scaled,timing.core.preset=forwarding,"
                                 "timing.l2.ways=4,clusters=3"));
  EXPECT_EQ(toJson(C), toJson(InOrder));
}

TEST(NamedMachines, TheNearestNameCounts) {
  Config C;
  ASSERT_TRUE(setValues(C, "machine=prototype,timing.link.to_l2_ns=50"));
  EXPECT_EQ(nameOf(C).Name, "prototype with changes");
  EXPECT_EQ(nameOf(C).Changes,
            std::vector<std::string>{"timing.link.to_l2_ns=50"});
  // In an object the machine comes first, wherever it stands.
  const auto Read = parseConfig(
      R"({"timing": {"link": {"to_l2_ns": 50}}, "machine": "prototype"})", "");
  ASSERT_TRUE(Read) << Read.error().What;
  EXPECT_EQ(toJson(*Read), toJson(C));
}

TEST(NamedMachines, APresetOfTheCoreLeavesTheSocketsCache) {
  Config C;
  ASSERT_TRUE(setValues(C, "machine=scaled,timing.core.preset=forwarding"));
  EXPECT_EQ(nameOf(C).Name, "scaled-forwarding");
}

TEST(NamedMachines, AnUnknownNameIsOneLineWithTheKnownOnes) {
  const auto Found = findMachine("protype");
  ASSERT_TRUE(Found);
  const auto C = parseConfig(Found->Json, Found->Where);
  ASSERT_FALSE(C);
  EXPECT_EQ(C.error().Where, "configuration");
  EXPECT_EQ(C.error().What, "machine is 'protype', expected one of prototype, "
                            "prototype-forwarding, prototype-on-chip, scaled, "
                            "scaled-forwarding; did you mean prototype?");
  EXPECT_EQ(C.error().Code, ExitCode::Usage) << "no file holds it";
  EXPECT_FALSE(findMachine("./nonexistent"));
}

} // namespace
