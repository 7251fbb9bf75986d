/// Energies and areas from events: what they add up to, what makes them grow,
/// and which technology files are refused.
#include "energy/Costs.h"
#include "energy/Stable.h"
#include "testing/TimedPrograms.h"
#include "timing/dram/Standards.h"
#include "vorion/isasim/Energy.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

using namespace vorion;
using namespace vorion::isasim;
using namespace vorion::isasim::testing;

namespace {

using Json = nlohmann::ordered_json;

EnergyModel model(unsigned Mhz = 530, std::optional<double> Volts = 0.8) {
  auto Made = EnergyModel::create(defaultTechnology(), Mhz, Volts);
  EXPECT_TRUE(Made) << Made.error().What;
  return std::move(*Made);
}

EnergyWork workOf(const TimeReport &R) {
  EnergyWork W{R.Cycles, R.ClockMhz, {}};
  for (const Activity &A : R.Activities)
    W.Events.push_back({A.Unit, A.Event, A.Count});
  return W;
}

double joules(const EnergyModel &M, const EnergyWork &W) {
  const auto E = M.energyOf(W);
  EXPECT_TRUE(E) << E.error().What;
  return E->Total.Value;
}

const TechnologyRow &row(const std::vector<TechnologyRow> &Rows,
                         std::string_view Name) {
  for (const TechnologyRow &R : Rows)
    if (R.Name == Name)
      return R;
  ADD_FAILURE() << Name;
  return Rows.front();
}

Json document() { return Json::parse(defaultTechnologyText()); }
std::string refusal(const Json &Of) {
  const auto T = parseTechnology(Of.dump(), "mine.json");
  EXPECT_FALSE(T);
  return T ? "" : T.error().Where + ": " + T.error().What;
}

} // namespace

TEST(Stable, IsTheHostsArithmeticWithinAFewPlaces) {
  for (double X = -20; X < 20; X += 0.37)
    EXPECT_NEAR(stable::exp(X) / std::exp(X), 1, 1e-11) << X;
  for (double X = 1e-9; X < 1e9; X *= 3.7)
    EXPECT_NEAR(stable::log(X), std::log(X),
                1e-13 * std::abs(std::log(X)) + 1e-15)
        << X;
  double Sum = 0, Squares = 0;
  for (unsigned N = 0; N != 100000; ++N) {
    const double D = stable::normal("a", N);
    Sum += D;
    Squares += D * D;
  }
  EXPECT_NEAR(Sum / 1e5, 0, 0.01);
  EXPECT_NEAR(Squares / 1e5, 1, 0.01);
}

TEST(Stable, HasTheSameBitsOnEveryHost) {
  EXPECT_EQ(stable::exp(0.5), 0x1.a61298e1e04cp+0);
  EXPECT_EQ(stable::pow(5.3, 1 / 1.3), 0x1.cdaf3893dc95dp+1);
  EXPECT_EQ(stable::normal("fp32 addition", 7), -0x1.7cdf6378723ep-3);
}

TEST(Energy, IsEventsTimesTheirRows) {
  const EnergyModel M = model();
  const EnergyWork W{1000,
                     500,
                     {{"core lane instructions", "fma", 100},
                      {"l2", "line reads", 3},
                      {"time", "links", 1000}}};
  const auto E = M.energyOf(W);
  ASSERT_TRUE(E);
  const auto Pj = [](std::string_view Row) {
    return row(defaultTechnology().Energies, Row).Value;
  };
  const double Lane = 2.5 * Pj("register read") + Pj("register written") +
                      Pj("lane latches") + Pj("fp32 addition") +
                      Pj("fp32 multiplication");
  EXPECT_NEAR(E->Chip.Value, 100e-12 * Lane, 1e-20);
  EXPECT_NEAR(E->Total.Value, 1e-12 * (100 * Lane + 24 * Pj("SRAM 1 MiB")),
              1e-20);
  double Sum = 0, Shares = 0;
  for (const UnitEnergy &U : E->Units) {
    Sum += U.Joules.Value;
    Shares += U.Share.Value;
  }
  EXPECT_NEAR(Sum, E->Total.Value, 1e-20);
  EXPECT_NEAR(Shares, 1, 1e-12);
  EXPECT_DOUBLE_EQ(E->Seconds, 2e-6);
  EXPECT_DOUBLE_EQ(E->Watts.Value, E->Total.Value / 2e-6);
}

TEST(Energy, WithoutALinkTheCachesAreOnTheChip) {
  const EnergyModel M = model();
  EnergyWork W{1000,
               500,
               {{"l2", "line reads", 3},
                {"llc", "line reads", 2},
                {"time", "KiB of the L2", 1000}}};
  const auto Alone = M.energyOf(W);
  EXPECT_EQ(Alone->Chip.Value, Alone->Total.Value);
  EXPECT_GT(M.areaOf(W).Chip.Value, 0);
  W.Events.push_back({"time", "links", 1000});
  EXPECT_EQ(M.energyOf(W)->Chip.Value, 0);
  EXPECT_EQ(M.areaOf(W).Chip.Value, 0);
}

TEST(Energy, ClocksGrowWithLanes) {
  const EnergyModel M = model();
  const auto Of = [&](std::string_view Event, uint64_t Count) {
    return M.energyOf({1000, 500, {{"time", Event, Count}}})->Total.Value;
  };
  for (const std::string_view Event :
       {"core lanes", "busy rasterizer lanes", "busy pixel unit lanes"}) {
    EXPECT_GT(Of(Event, 16000), 0) << Event;
    EXPECT_NEAR(Of(Event, 32000) / Of(Event, 16000), 2, 1e-9) << Event;
  }
}

TEST(Energy, GrowsWithEveryEventAndWithTheVoltage) {
  const EnergyModel Low = model(530, 0.6), Middle = model(),
                    High = model(530, 1.15);
  for (const EventCost &C : eventCosts()) {
    EnergyWork Few{1, 530, {{C.Unit, C.Event, 10}}}, More = Few;
    More.Events[0].Count = 11;
    EXPECT_LE(joules(Middle, Few), joules(Middle, More)) << C.Unit << C.Event;
    EXPECT_LE(joules(Low, Few), joules(Middle, Few)) << C.Unit << C.Event;
    EXPECT_LE(joules(Middle, Few), joules(High, Few)) << C.Unit << C.Event;
  }
  for (const AreaCost &C : areaCosts()) {
    const EnergyWork W{1, 530, {{"time", C.Event, 1000}}};
    EXPECT_GT(joules(Middle, W), 0) << C.Event;
    EXPECT_LT(joules(Middle, W), joules(High, W)) << C.Event;
  }
}

TEST(Energy, IntervalsHoldTheValueAndRatiosShareDraws) {
  const EnergyModel M = model();
  const EnergyWork One{1, 530, {{"core lane instructions", "fma", 100}}};
  EnergyWork Two = One;
  Two.Events[0].Count *= 2;
  const auto A = M.energyOf(One), B = M.energyOf(Two);
  ASSERT_TRUE(A && B);
  EXPECT_LT(A->Total.Low, A->Total.Value);
  EXPECT_GT(A->Total.High, A->Total.Value);
  // What is unsure of both is sure of their ratio.
  const Estimate R =
      ratioOf(B->TotalDraws, B->Total.Value, A->TotalDraws, A->Total.Value);
  EXPECT_NEAR(R.Low, 2, 1e-9);
  EXPECT_NEAR(R.High, 2, 1e-9);
  const auto Again = model().energyOf(One);
  EXPECT_EQ(Again->TotalDraws, A->TotalDraws);
}

TEST(Energy, ArithmeticLiesBetweenWhatWasPublishedAt45And7Nm) {
  struct Published {
    const char *Row;
    double At45, At7;
  };
  for (const auto &[Row, At45, At7] : {Published{"fp32 addition", 0.9, 0.38},
                                       {"fp32 multiplication", 3.7, 1.31},
                                       {"int32 addition", 0.1, 0.03},
                                       {"int32 multiplication", 3.1, 1.48},
                                       {"SRAM 8 KiB", 10, 7.5},
                                       {"SRAM 1 MiB", 100, 14}}) {
    // Stillmaker and Baas 2017, coefficients of 45, 16 and 7 nm.
    const auto Curve = [](double A, double B, double C, double V) {
      return A * V * V + B * V + C;
    };
    const double E45 = Curve(1.103, -0.362, 0.2767, 0.9),
                 E16 = Curve(0.2958, -0.1241, 0.03024, 0.8),
                 E7 = Curve(0.1776, -0.09097, 0.02447, 0.7);
    const double Place = std::log(E45 / E16) / std::log(E45 / E7);
    const double Ours = row(defaultTechnology().Energies, Row).Value;
    EXPECT_NEAR(Ours / (std::pow(At45, 1 - Place) * std::pow(At7, Place)), 1,
                0.005)
        << Row;
    EXPECT_LT(Ours, At45) << Row;
    EXPECT_GT(Ours, At7) << Row;
  }
}

/// Celerity (Rovinski et al., IEEE SSC-L 2(12), 2019): 496 cores of 32 bits in
/// 16 nm reach 314.89 giga-instructions a second and watt at their best, which
/// is 3.2 pJ an instruction. Ariane (Zaruba and Benini, IEEE TVLSI 27(11),
/// 2019): 40 Gop a second and watt of 64 bits in 22 nm at its best, which is 25
/// pJ.
TEST(Energy, AnInstructionOfOneLaneIsWorthWhatCoresWerePublishedWith) {
  const EnergyWork One{1,
                       530,
                       {{"core warp instructions", "alu", 1},
                        {"core lane instructions", "alu", 1}}};
  const double AtBest = joules(model(100, 0.57), One);
  EXPECT_GT(AtBest, 3.2e-12);
  EXPECT_LT(AtBest, 25e-12);
}

TEST(Energy, KnowsAllEventsOfAMachineThatHasEverything) {
  class Run : public ClockTest {
  public:
    void TestBody() override {}
    TimeReport whole() {
      const auto Named = setValues(
          Settings, "machine=prototype,timing.core.dcache_kib=16,"
                    "timing.raster.tile_overlap=2,timing.raster.skip_blocks=3,"
                    "timing.host.dma_engines=1");
      EXPECT_TRUE(Named);
      Settings.Timing.Enabled = true;
      return run({});
    }
  } R;
  const TimeReport Report = R.whole();
  for (const Activity &A : Report.Activities)
    EXPECT_TRUE(knowsEvent({A.Unit, A.Event, A.Count}))
        << A.Unit << ": " << A.Event;
  // And no cost is of an event that no report has. Other kinds of primitives,
  // and ranges, are in reports of runs that have some.
  for (const EventCost &C : eventCosts()) {
    bool Known = C.Unit == "rasterizer front end" ||
                 C.Event == "words of ranges loaded" ||
                 C.Event == "pixels of rays" || C.Event == "pixels of surfels";
    for (const Activity &A : Report.Activities)
      Known |= A.Unit == C.Unit && A.Event == C.Event;
    EXPECT_TRUE(Known) << C.Unit << ": " << C.Event;
  }
  EXPECT_GT(joules(model(), workOf(Report)), 0);
}

TEST(Energy, DramDrawsItsCurrents) {
  // Micron's sheet of 1 Gb x8 at 1.5 V: (140 - 45) mA for 5 ns, eight devices.
  const EnergyModel M = model();
  const EnergyWork Still{1000, 1000, {{"dram channels", "ddr3-1600", 1000}}};
  EXPECT_NEAR(joules(M, Still), 8 * 1.5 * 45e-3 * 1e-6, 1e-15);
  EnergyWork Reads = Still;
  Reads.Events.push_back({"dram", "read bursts", 1});
  EXPECT_NEAR(joules(M, Reads) - joules(M, Still), 8 * 1.5 * 95e-3 * 5e-9,
              1e-15);
  // And of 8 Gb x8 of DDR4, which has a supply of 2.5 V besides.
  EnergyWork Double{1000, 1000, {{"dram channels", "ddr4-3200", 1000}}};
  const double Idle = joules(M, Double);
  EXPECT_NEAR(Idle, 8 * (1.2 * 52e-3 + 2.5 * 3e-3) * 1e-6, 1e-15);
  Double.Events.push_back({"dram", "read bursts", 1});
  const double Read = joules(M, Double) - Idle;
  EXPECT_NEAR(Read, 8 * 1.2 * 116e-3 * 2.5e-9, 1e-15);
  Double.Events.push_back({"dram", "activations", 1});
  EXPECT_NEAR(joules(M, Double) - Idle - Read,
              8 * 1.2 * (57 * 46.25 - 52 * 32.5 - 37 * 13.75) * 1e-12, 1e-15);
  Double.Events.back() = {"dram", "refreshes", 1};
  EXPECT_NEAR(joules(M, Double) - Idle - Read,
              8 * (1.2 * 198e-3 + 2.5 * 25e-3) * 350e-9, 1e-14);
  const auto Unknown =
      M.energyOf({1000, 1000, {{"dram channels", "hbm2e", 1000}}});
  ASSERT_FALSE(Unknown);
  EXPECT_NE(Unknown.error().What.find("hbm2e"), std::string::npos);
}

TEST(Technology, TimesOfDramAreThoseOfTheClock) {
  for (const DramCurrents &D : defaultTechnology().Dram) {
    const auto Text = Json::parse(dram::standardText(D.Standard));
    const double Tick = Text["tick_ps"].get<double>() / 1e3;
    const auto Ns = [&](const char *Value) {
      return Tick * Text["values"][Value][0].get<double>();
    };
    EXPECT_DOUBLE_EQ(D.RasNs, Ns("nRAS"));
    EXPECT_DOUBLE_EQ(D.BurstNs, Ns("nBL"));
    const bool IsLow = D.Standard.starts_with("lp");
    EXPECT_DOUBLE_EQ(D.RcNs, Text["values"].contains("nRC")
                                 ? Ns("nRC")
                                 : Ns("nRAS") + Ns(IsLow ? "nRPpb" : "nRP"));
    EXPECT_DOUBLE_EQ(D.RfcNs, Ns(IsLow ? "nRFCab" : "nRFC"));
  }
}

TEST(Technology, VoltageAndClockFollowTheLaw) {
  const Technology &T = defaultTechnology();
  EXPECT_NEAR(clockAt(T, 0.57), 100, 1e-9);
  EXPECT_NEAR(clockAt(T, 1.15), 530, 1e-9);
  EXPECT_EQ(*voltsFor(T, 530), 1.15);
  EXPECT_EQ(*voltsFor(T, 50), 0.57);
  EXPECT_FALSE(voltsFor(T, 531));
  double Before = 0;
  for (double Mhz = 100; Mhz <= 530; Mhz += 10) {
    const double V = *voltsFor(T, Mhz);
    EXPECT_NEAR(clockAt(T, V), Mhz, 1e-6);
    EXPECT_GT(V, Before);
    Before = V;
  }
  const auto Fast = EnergyModel::create(T, 2000, std::nullopt);
  ASSERT_FALSE(Fast);
  EXPECT_EQ(Fast.error().Code, ExitCode::Usage);
}

TEST(Technology, WrongFilesAreRefusedByTheirKeys) {
  Json Missing = document();
  Missing["energies"].erase("tile command");
  EXPECT_NE(
      refusal(Missing).find("mine.json: key energies.tile command is missing"),
      std::string::npos)
      << refusal(Missing);
  Json Unknown = document();
  Unknown["areas"]["gaet"] = Unknown["areas"]["gate"];
  EXPECT_NE(refusal(Unknown).find("mine.json: unknown key areas.gaet"),
            std::string::npos)
      << refusal(Unknown);
  Json Negative = document();
  Negative["energies"]["core cycle"]["pj"] = -1;
  EXPECT_NE(
      refusal(Negative).find("mine.json: key energies.core cycle.pj is -1"),
      std::string::npos)
      << refusal(Negative);
  Json Current = document();
  Current["dram"]["ddr3-1600"]["rails"][0]["idd5"] = -3;
  EXPECT_NE(refusal(Current).find("idd5 is -3"), std::string::npos);
  Json Exact = document();
  Exact["chip"]["watts_sigma"] = 0;
  EXPECT_NE(refusal(Exact).find("key chip.watts_sigma is 0"),
            std::string::npos);
  Json Idle = document();
  Idle["chip"]["activities"][0]["event"] = "naps";
  EXPECT_NE(refusal(Idle).find("naps', expected one of a time report"),
            std::string::npos)
      << refusal(Idle);
  EXPECT_FALSE(parseTechnology("[", "mine.json"));
  EXPECT_FALSE(parseTechnology("{}", "mine.json"));
}

TEST(Area, IsThatOfItsParts) {
  const EnergyWork W{1000,
                     530,
                     {{"time", "rasterizers", 2000},
                      {"time", "KiB of the L2", 1000},
                      {"time", "links", 1000}}};
  const Area A = model().areaOf(W);
  double Chip = 0;
  for (const PartArea &P : A.Parts)
    if (P.Name != "l2")
      Chip += P.Um2.Value;
  EXPECT_NEAR(A.Chip.Value, Chip, 1e-6);
  EXPECT_LT(A.Chip.Low, A.Chip.Value);
}

TEST(Technology, ACommandTakesNoLessThanADeviceThatStands) {
  for (const char *Key : {"idd0", "idd4r", "idd4w", "idd5"}) {
    Json Less = document();
    Less["dram"]["ddr3-1600"]["rails"][0][Key] = 44;
    EXPECT_EQ(refusal(Less),
              fmt::format(
                  "mine.json: key dram.ddr3-1600.rails.{} is 44, expected at "
                  "least 45, the standby current of the device (idd2n, idd3n)",
                  Key));
  }
}

TEST(Technology, WhatReportsPrintIsOnOneLine) {
  Json Name = document();
  Name["technology"] = "mine\npower: 0 W";
  EXPECT_EQ(refusal(Name), "mine.json: key technology has 'mine\\x0apower: 0 "
                           "W', expected printable characters on one line");
  Json Source = document();
  Source["areas"]["gate"]["source"] = "\x1b[31m";
  EXPECT_NE(refusal(Source).find("key areas.gate.source has '\\x1b[31m'"),
            std::string::npos)
      << refusal(Source);
  Json Standard = document();
  Standard["dram"]["a\nb"] = Standard["dram"]["ddr3-1600"];
  EXPECT_NE(refusal(Standard).find("key dram has 'a\\x0ab'"), std::string::npos)
      << refusal(Standard);
}

namespace {

/// A technology in which only a gate has an area and only a core's cycle an
/// energy, and a chip of a core and a cycle with twice the area and half the
/// power that the rows say.
Technology twoRows() {
  Technology T = defaultTechnology();
  for (std::vector<TechnologyRow> *Rows : {&T.Areas, &T.Energies})
    for (TechnologyRow &R : *Rows)
      if (R.Name != "gate" && R.Name != "core cycle")
        R.Value = 0;
  PublishedChip C;
  C.Cycles = 1000;
  C.ClockMhz = 100;
  C.Volts = T.Volts;
  C.Events = {{"time", "cores", 1000}, {"time", "core lanes", 16000}};
  const auto Model = EnergyModel::create(T, C.ClockMhz, C.Volts);
  C.Mm2 = 2 * Model->areaOf(C.work()).Chip.Value * 1e-6;
  C.Watts = 0.5 * Model->energyOf(C.work())->ChipWatts.Value;
  C.AreaSigma = 0.3;
  C.PowerSigma = 0.4;
  T.Chip = C;
  return T;
}

double sigmaOf(const std::vector<TechnologyRow> &Rows, std::string_view Name,
               const Technology &T) {
  return std::hypot(row(Rows, Name).Sigma, T.Sigma);
}

/// The logarithms' mean and standard deviation.
std::pair<double, double> logsOf(const std::vector<double> &Draws) {
  double Sum = 0, Squares = 0;
  for (const double D : Draws) {
    Sum += std::log(D);
    Squares += std::log(D) * std::log(D);
  }
  const double Mean = Sum / double(Draws.size());
  return {Mean, std::sqrt(Squares / double(Draws.size()) - Mean * Mean)};
}

} // namespace

/// Of a log-normal with sigma S, and a published figure f times its median with
/// tolerance T, the logarithm is normal: its mean is ln f S^2 / (S^2 + T^2),
/// its variance S^2 T^2 / (S^2 + T^2), and a sample is kept with the
/// probability T / sqrt(S^2 + T^2) exp(-(ln f)^2 / 2 (S^2 + T^2)).
TEST(GivenChip, IsTheClosedFormOfLogNormals) {
  const Technology T = twoRows();
  const auto Given = samplesGivenChip(T);
  ASSERT_TRUE(Given) << Given.error().What;
  const auto Model = [&](const Samples &By) {
    return *EnergyModel::create(T, T.Chip->ClockMhz, T.Chip->Volts, By);
  };
  const EnergyWork Work = T.Chip->work();
  const auto Expect = [&](const std::vector<double> &Draws, double Median,
                          double Factor, double S, double Tolerance) {
    const double Both = S * S + Tolerance * Tolerance;
    const auto [Mean, Sigma] = logsOf(Draws);
    EXPECT_NEAR(Mean - std::log(Median), std::log(Factor) * S * S / Both, 0.03);
    EXPECT_NEAR(Sigma, S * Tolerance / std::sqrt(Both), 0.02);
  };
  const double AreaSigma = sigmaOf(T.Areas, "gate", T),
               PowerSigma = sigmaOf(T.Energies, "core cycle", T);
  const double Um2 = T.Chip->Mm2 / 2 * 1e6, Joules = 2 * T.Chip->Watts * 1e-5;
  for (const Samples *By : {&Given->Area, &Given->Both})
    Expect(Model(*By).areaOf(Work).ChipDraws, Um2, 2, AreaSigma, 0.3);
  for (const Samples *By : {&Given->Power, &Given->Both})
    Expect(Model(*By).energyOf(Work)->ChipDraws, Joules, 0.5, PowerSigma, 0.4);
  const auto Kept = [](double S, double Tolerance) {
    const double Both = S * S + Tolerance * Tolerance;
    return Tolerance / std::sqrt(Both) *
           std::exp(-std::log(2) * std::log(2) / 2 / Both);
  };
  const double Area = Kept(AreaSigma, 0.3), Power = Kept(PowerSigma, 0.4);
  const auto Tried = [](const Samples &S) { return double(S.Tried); };
  EXPECT_EQ(Given->Both.Numbers.size(), size_t(Samples::Count));
  EXPECT_NEAR(Tried(Given->Area) * Area / Samples::Count, 1, 0.3);
  EXPECT_NEAR(Tried(Given->Both) * Area * Power / Samples::Count, 1, 0.2);
}

TEST(GivenChip, MovesRowsAsFarAsTheyShareItsUncertainty) {
  const Technology T = twoRows();
  const EnergyModel M =
      *EnergyModel::create(T, 100, T.Chip->Volts, samplesGivenChip(T)->Area);
  const double S = sigmaOf(T.Areas, "gate", T);
  const double Shift = std::log(2) * S * S / (S * S + 0.09);
  // What all areas share is as much of the shift as of the variance.
  const double Shared = Shift * T.Sigma * T.Sigma / (S * S);
  const std::vector<RowFactor> Rows = M.rowFactors();
  for (const RowFactor &R : Rows) {
    const double Expected = !R.IsArea ? 0 : R.Row == "gate" ? Shift : Shared;
    EXPECT_NEAR(std::log(R.Factor.Value), Expected, 0.12) << R.Row;
    EXPECT_LT(R.Factor.Low, R.Factor.Value) << R.Row;
  }
  // Figures are those of the rows at their medians.
  const auto Gate = std::ranges::find(Rows, "gate", &RowFactor::Row);
  EXPECT_NEAR(M.areaOf(T.Chip->work()).Chip.Value,
              T.Chip->Mm2 / 2 * 1e6 * Gate->Factor.Value, 1e-6);
}

TEST(GivenChip, OfTheDefaultIsThePrototypeAtItsFastest) {
  const Technology &T = defaultTechnology();
  ASSERT_TRUE(T.Chip);
  EXPECT_EQ(T.Chip->Volts, *voltsFor(T, T.Chip->ClockMhz));
  const EnergyWork Work = T.Chip->work();
  for (const auto &[Event, Count] :
       {std::pair{"cores", 8}, {"core lanes", 128}, {"rasterizers", 2}}) {
    const auto Of = std::ranges::find_if(Work.Events, [&](const EventCount &E) {
      return E.Unit == "time" && E.Event == Event;
    });
    ASSERT_NE(Of, Work.Events.end()) << Event;
    EXPECT_EQ(Of->Count, Count * Work.Cycles) << Event;
  }
}

TEST(GivenChip, NeedsAChipThatTheRowsDoNotContradict) {
  Technology T = twoRows();
  T.Chip->Mm2 *= 1000;
  const auto Far = samplesGivenChip(T);
  ASSERT_FALSE(Far);
  EXPECT_NE(Far.error().What.find("contradicts its chip"), std::string::npos);
  T.Chip.reset();
  const auto None = samplesGivenChip(T);
  ASSERT_FALSE(None);
  EXPECT_NE(None.error().What.find("has no chip"), std::string::npos);
}
