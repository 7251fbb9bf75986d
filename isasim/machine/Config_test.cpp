#include "vorion/isasim/Config.h"

#include "core/IsaTables.h"
#include "vorion/isasim/MemoryMap.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

using namespace vorion;
using namespace vorion::isasim;

static std::string wrongIn(std::string_view Json) {
  const Expected<Config> C = parseConfig(Json, "file.json");
  return C ? "" : C.error().Where + ": " + C.error().What;
}

TEST(Config, DefaultHasThePrototypesUnits) {
  const Config C;
  EXPECT_EQ(C.cores(), 8U);
  EXPECT_EQ(C.sockets(), 2U);
  EXPECT_TRUE(validate(C));
}

TEST(Config, JsonRoundTrip) {
  Config C;
  C.Clusters = 4;
  C.SocketsPerCluster = 4;
  C.LanesPerWarp = 5;
  C.GlobalBytes = 1 << 24;
  C.MaxInstructions = 12345678901;
  C.Raster.QueueDepth = 9;
  C.Timing.Enabled = true;
  C.Timing.Dram.ControllerPs = 12345;
  C.Timing.Dram.Standard = "ddr3-1600";
  const Expected<Config> Back = parseConfig(toJson(C), "");
  ASSERT_TRUE(Back) << Back.error().What;
  EXPECT_EQ(toJson(*Back), toJson(C));
  EXPECT_EQ(Back->MaxInstructions, 12345678901U);
  EXPECT_TRUE(Back->Timing.Enabled);
  EXPECT_EQ(Back->Timing.Dram.ControllerPs, 12345U);
  EXPECT_EQ(Back->Timing.Dram.Standard, "ddr3-1600");
}

TEST(Config, MissingKeysKeepTheirDefault) {
  const Expected<Config> C = parseConfig(R"({"lanes_per_warp": 4})", "");
  ASSERT_TRUE(C);
  EXPECT_EQ(C->LanesPerWarp, 4U);
  EXPECT_EQ(C->CoresPerSocket, 4U);
}

TEST(Config, APresetIsASetOfNumbersThatSingleKeysChange) {
  Config C = defaultMachine();
  ASSERT_TRUE(setValues(C, "timing.core.fetch_interval=9,"
                           "timing.core.preset=vortex-2025,"
                           "timing.core.branch_cycles=7"));
  EXPECT_EQ(C.Timing.Preset, CorePreset::Vortex2025);
  EXPECT_EQ(C.Timing.Core.FetchInterval, 9U) << "a preset undoes no value";
  EXPECT_EQ(C.Timing.Core.BranchCycles, 7U);
  ASSERT_TRUE(setValues(C, "timing.core.fetch_interval=6"));
  EXPECT_EQ(C.Timing.Core.FetchInterval, 6U) << "another list does";
  // In an object the preset comes first, wherever it stands.
  const Expected<Config> Read = parseConfig(
      R"({"timing": {"core": {"branch_cycles": 7, "preset": "vortex-2025"}}})",
      "");
  ASSERT_TRUE(Read) << Read.error().What;
  EXPECT_EQ(toJson(*Read), toJson(C));
  const Expected<Config> Back = parseConfig(toJson(C), "");
  ASSERT_TRUE(Back) << Back.error().What;
  EXPECT_EQ(toJson(*Back), toJson(C));
}

/// The default machine, changed.
Config changed(std::string_view List) {
  Config C = defaultMachine();
  const auto Set = setValues(C, List);
  EXPECT_TRUE(Set) << Set.error().What;
  return C;
}

TEST(Config, ShortNamesAndEndsOfKeys) {
  const auto Same = [](std::string_view Short, std::string_view Whole) {
    EXPECT_EQ(toJson(changed(Short)), toJson(changed(Whole))) << Short;
  };
  Same("lanes=32", "timing.raster.lanes=32");
  Same("dram=lpddr5-6400", "timing.dram.standard=lpddr5-6400");
  Same("queue_depth=9", "raster.queue_depth=9");
  Same("l2.kib=64", "timing.l2.kib=64");
  Same("preset=vortex-2025,branch_cycles=7",
       "timing.core.branch_cycles=7,timing.core.preset=vortex-2025");
  Same("rasterizers=4", "sockets_per_cluster=4");
  Same("cores=16", "sockets_per_cluster=4");
  Same("cores=16,machine=scaled", "machine=scaled,sockets_per_cluster=1");
  Same("cores=8,rasterizers=4", "sockets_per_cluster=4,cores_per_socket=2");
  Same("cores=6,cores_per_socket=3",
       "sockets_per_cluster=2,cores_per_socket=3");
  Config C = defaultMachine();
  EXPECT_EQ(setValues(C, "rasterizers=3,clusters=2").error().What,
            "rasterizers is 3, expected a multiple of 2, the clusters");
  EXPECT_EQ(setValues(C, "cores=6,rasterizers=4").error().What,
            "cores is 6, expected a multiple of 4, the sockets");
  EXPECT_EQ(setValues(C, "cores=many").error().What,
            "cores is 'many', expected a whole number, 1 to 4096");
  EXPECT_EQ(setValues(C, "ways=4").error().What,
            "'ways' is ambiguous, expected one of "
            "timing.l2.ways, timing.llc.ways");
}

TEST(Config, WhatChangesNothingIsSaidWithTheKeyThatIsWhy) {
  using Notes = std::vector<std::string>;
  const auto Idle = [](std::string_view List) {
    const std::string Timed = fmt::format("timing.enabled=1,{}", List);
    Config Before = defaultMachine();
    Before.Timing.Enabled = true;
    return idleSettings(Before, changed(Timed), Timed);
  };
  EXPECT_EQ(Idle("lanes=32"),
            Notes({"timing.raster.lanes=32 has no effect on cycles of renders: "
                   "timing.raster.banks is 16"}));
  EXPECT_EQ(Idle("lanes=32,raster.banks=32"), Notes());
  EXPECT_EQ(Idle("lanes=8"), Notes());
  EXPECT_EQ(Idle("lanes=64"),
            Notes({"timing.raster.lanes=64 has no effect on cycles of renders: "
                   "timing.raster.banks is 16"}));
  EXPECT_EQ(Idle("raster.banks=64"), Notes());
  EXPECT_EQ(
      Idle("raster.lanes=16"),
      Notes(
          {"timing.raster.lanes=16 has no effect: it is the machine's value"}));
  EXPECT_EQ(Idle("dcache_ways=2"),
            Notes({"timing.core.dcache_ways=2 has no effect on cycles: "
                   "timing.core.dcache_kib is 0"}));
  EXPECT_EQ(Idle("dcache_ways=2,dcache_kib=16"), Notes());
  EXPECT_EQ(Idle("fpu_lanes=4,core.fpu=0"),
            Notes({"timing.core.fpu_lanes=4 has no effect on cycles: "
                   "timing.core.fpu is 0"}));
  EXPECT_EQ(Idle("dram=lpddr5-6400,fixed_cycles=5"),
            Notes({"timing.dram.standard=lpddr5-6400 has no effect on cycles: "
                   "timing.l2.fixed_cycles is 5"}));
  EXPECT_EQ(Idle("l2.queue=4"),
            Notes({"timing.l2.queue=4 has no effect on cycles: "
                   "timing.l2.crossbar is 0"}));
  EXPECT_EQ(Idle("llc.kib=64,constant_cycles=50"),
            Notes({"timing.llc.kib=64 has no effect on cycles: "
                   "timing.llc.constant_cycles is 50"}));
  EXPECT_EQ(Idle("lanes_per_warp=8,alu_lanes=8"),
            Notes({"timing.core.alu_lanes=8 has no effect on cycles: "
                   "lanes_per_warp is 8"}));
  // Keys of the run change how it is computed, and nothing that is said.
  EXPECT_EQ(Idle("host_threads=0"), Notes());
  // Without the clock no key of it is read.
  EXPECT_EQ(
      idleSettings(defaultMachine(), changed("l2.kib=64"), "l2.kib=64"),
      Notes({"timing.l2.kib=64 has no effect on cycles: timing.enabled is 0"}));
}

TEST(Config, AnObjectIsNoKey) {
  Config C = defaultMachine();
  const auto Set = setValues(C, "raster=4");
  ASSERT_FALSE(Set);
  EXPECT_EQ(Set.error().What, "'raster' is an object and not a key, expected "
                              "'raster.' and one of queue_depth");
}

TEST(Config, ErrorsNameTheKey) {
  EXPECT_EQ(
      wrongIn(R"({"cores": 4})"),
      "file.json: unknown key 'cores', expected one of machine, clusters, "
      "sockets_per_cluster, cores_per_socket, warps_per_core, "
      "lanes_per_warp, barriers, divergence_depth, global_bytes, "
      "local_bytes, stack_bytes, quantum, max_instructions, "
      "host_threads, engine, raster, timing; did you mean "
      "cores_per_socket?");
  EXPECT_EQ(
      wrongIn(R"({"raster": {"deep": 4}})"),
      "file.json: unknown key 'raster.deep', expected one of queue_depth");
  EXPECT_EQ(wrongIn(R"({"raster": {"": 4}})"),
            "file.json: unknown key 'raster.', expected one of queue_depth");
  // A path of two names is no name.
  EXPECT_TRUE(wrongIn(R"({"raster.queue_depth": 4})")
                  .starts_with("file.json: unknown key 'raster.queue_depth', "
                               "expected one of machine, clusters"));
  EXPECT_EQ(wrongIn(R"({"lanes_per_warp": "many"})"),
            "file.json: lanes_per_warp: expected a whole number");
  EXPECT_EQ(wrongIn(R"({"lanes_per_warp": -1})"),
            "file.json: lanes_per_warp: expected a whole number");
  EXPECT_EQ(wrongIn(R"({"lanes_per_warp": 17})"),
            "file.json: lanes_per_warp is 17, expected 1 to 16");
  EXPECT_EQ(wrongIn(R"({"stack_bytes": 5000})"),
            "file.json: stack_bytes is 5000, expected a multiple of 4096");
  EXPECT_EQ(wrongIn(R"({"stack_bytes": 12288})"),
            "file.json: stack_bytes is 12288, expected a power of two");
  EXPECT_EQ(wrongIn("[1]"), "file.json: expected a JSON object");
  EXPECT_EQ(wrongIn(R"({"raster": 1})"),
            "file.json: raster: expected a JSON object");
  EXPECT_EQ(wrongIn(R"({"timing": {"core": {"fast": 1}}})").substr(0, 58),
            "file.json: unknown key 'timing.core.fast', expected one of");
  EXPECT_EQ(wrongIn(R"({"timing": {"core": {"preset": "vortex"}}})"),
            "file.json: timing.core.preset is 'vortex', expected one of "
            "forwarding, vortex-5stage, vortex-2025");
  EXPECT_EQ(wrongIn(R"({"timing": {"core": {"preset": 1}}})"),
            "file.json: timing.core.preset: expected one of forwarding, "
            "vortex-5stage, vortex-2025");
  EXPECT_EQ(wrongIn(R"({"timing": {"l2": {"ways": 0}}})"),
            "file.json: timing.l2.ways is 0, expected 1 to 64");
  EXPECT_EQ(wrongIn(R"({"timing": {"dram": {"standard": 3200}}})"),
            "file.json: timing.dram.standard: expected a text");
  EXPECT_EQ(
      wrongIn(R"({"timing": {"dram": {"address_map": "zigzag"}}})"),
      "file.json: timing.dram.address_map: \"zigzag\" is not an address map, "
      "expected one of digit_sum, row_bank_column, xor");
  EXPECT_EQ(wrongIn(R"({"timing": {"l2": {"kib": 1, "ways": 17}}})"),
            "file.json: timing.l2.ways is 17, expected at most the 16 lines of "
            "1 KiB");
  EXPECT_NE(wrongIn("{").find("not JSON"), std::string::npos);
}

TEST(Config, TheMemoryMapMustHaveRoom) {
  EXPECT_EQ(wrongIn(R"({"clusters": 100, "sockets_per_cluster": 100})"),
            "file.json: 40000 cores, expected at most 4096");
  EXPECT_TRUE(parseConfig(R"({"clusters": 1024, "sockets_per_cluster": 1,
                              "cores_per_socket": 4, "stack_bytes": 16384})",
                          ""));
  EXPECT_EQ(wrongIn(R"({"stack_bytes": 16777216})"),
            "file.json: the stacks take 2147483648 bytes, expected at most "
            "2130640896");
  // Global memory behind the image and the stacks share what is there.
  EXPECT_EQ(wrongIn(R"({"global_bytes": 4278059008})"),
            "file.json: the stacks take 8388608 bytes, expected at most 0 with "
            "4278059008 bytes of global memory");
  EXPECT_TRUE(parseConfig(R"({"global_bytes": 4269670400})", ""));
  EXPECT_FALSE(parseConfig(R"({"global_bytes": 4269674496})", ""));
}

TEST(Config, GlobalMemoryIsInFrontOfTheImageAndBehindIt) {
  Config C;
  C.GlobalBytes = 1 << 30;
  EXPECT_EQ(globalRanges(C)[0].Bytes, 1U << 30);
  EXPECT_EQ(globalRanges(C)[1].Bytes, 0U);
  C.GlobalBytes = 3ULL << 30;
  const auto [Low, High] = globalRanges(C);
  EXPECT_EQ(Low.Base + Low.Bytes, VX_IMAGE_BASE);
  EXPECT_EQ(High.Base, VX_IMAGE_BASE + VX_IMAGE_SIZE);
  EXPECT_EQ(Low.Bytes + High.Bytes, 3ULL << 30);
}

TEST(Config, GlobalMemoryBeginsBehindTheIoWindow) {
  Config C;
  const auto BaseOf = [&](unsigned Clusters, unsigned CoresPerSocket) {
    C.Clusters = Clusters;
    C.SocketsPerCluster = 1;
    C.CoresPerSocket = CoresPerSocket;
    return globalBase(C);
  };
  EXPECT_EQ(BaseOf(1, 1), VX_GLOBAL_BASE);
  EXPECT_EQ(BaseOf(1, 240), VX_GLOBAL_BASE);
  EXPECT_EQ(BaseOf(1, 241), VX_GLOBAL_BASE + 0x1000);
  EXPECT_EQ(BaseOf(1, 256), VX_GLOBAL_BASE + 0x1000);
  EXPECT_EQ(BaseOf(1024, 4), 0x101000U);
  EXPECT_EQ(globalRanges(C)[0].Base, globalBase(C));
  EXPECT_EQ(globalRanges(C)[0].Base + globalRanges(C)[0].Bytes, VX_IMAGE_BASE);
}

TEST(Config, GlobalMemoryFillsTheMapByDefault) {
  Config C;
  EXPECT_EQ(globalBytes(C), 4269670400); // see TheMemoryMapMustHaveRoom
  C.CoresPerSocket = 120;
  EXPECT_TRUE(validate(C));
  EXPECT_EQ(globalBytes(C), 4269670400 - (stackBytes(C) - (8 << 20)));
}
