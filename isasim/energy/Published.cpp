#include "energy/Published.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace vorion::isasim {

namespace {

constexpr std::string_view Warp = "core warp instructions",
                           Lane = "core lane instructions";

constexpr std::string_view Celerity =
    "Celerity, 496 cores: Rovinski et al., IEEE SSC-L 2(12) (2019), 314.89 "
    "giga-instructions a second and watt";
constexpr std::string_view Ariane =
    "Zaruba and Benini, IEEE TVLSI 27(11) (2019), abstract: 40 Gop a second "
    "and watt, 64 bits";
/// A board's power above idle, so that losses of its regulators are in it.
constexpr std::string_view Instructions =
    "ET-SoC-1, measured: yaroslavvb/et-soc1-prototyping, energy manual (2026), "
    "section 3; operands of zeros, and random ones";
constexpr std::string_view Bytes =
    "the same, sections 4.1 and 4.2: 0.37 to 0.56 and 2.36 to 2.64 pJ a byte, "
    "with the load's instruction";
constexpr std::string_view Mesh =
    "the same repository, findings, 20, heat per mm: 37 and 53 fJ a random bit "
    "and mm, routers included";
constexpr std::string_view Dram =
    "the same manual, README: 68 to 73 pJ a byte beside the chip's rails";
constexpr std::string_view AccelWattch =
    "AccelWattch (Kandiah et al., MICRO 2021) with its coefficients of a Volta "
    "QV100, commit 667834c, dynamic; its voltage is not stated";
constexpr std::string_view Cacti =
    "CACTI 7.0, commit 1ffd8df: itrs-hp, 330 K, weights 0:100:100:0:0; read "
    "and write";
constexpr std::string_view CactiArea = "the same, of a whole array of cells";
constexpr std::string_view CactiLeaks = "the same, 32 KiB of itrs-lstp and "
                                        "itrs-hp";

/// An instruction of \p Class in \p Lanes of so many warps.
std::vector<EventCount> instruction(std::string_view Class, uint64_t Warps,
                                    uint64_t Lanes) {
  return {{Warp, Class, Warps}, {Lane, Class, Lanes}};
}
/// The same in a cycle in which no other lane has a clock.
std::vector<EventCount> clocked(std::string_view Class, uint64_t Lanes) {
  std::vector<EventCount> Events = instruction(Class, 1, Lanes);
  Events.push_back({"time", "core lanes", Lanes});
  return Events;
}

} // namespace

std::span<const PublishedFigure> publishedFigures() {
  static const std::vector<PublishedFigure> All = {
      {"an instruction of one lane, without clock and leakage, and one of a "
       "core of 32 bits at its best voltage",
       "16 nm", 0.57, 3.2, 3.2, "", 0, instruction("alu", 1, 1), Celerity},
      {"the same, and an operation of a core of 64 bits with virtual memory",
       "22 nm", 0.57, 25, 25, "", 0, instruction("alu", 1, 1), Ariane},
      {"an integer addition, one lane", "7 nm", 0.52, 5.7, 9.2, "", 0,
       clocked("alu", 1), Instructions},
      {"an integer addition, eight lanes", "7 nm", 0.52, 13.3, 20.1, "", 0,
       clocked("alu", 8), Instructions},
      {"a fused multiplication of fp32, one lane", "7 nm", 0.52, 27.0, 31.1, "",
       0, clocked("fma", 1), Instructions},
      {"a fused multiplication of fp32, eight lanes", "7 nm", 0.52, 26.6, 55.9,
       "", 0, clocked("fma", 8), Instructions},
      {"an integer addition, 32 lanes of two warps, and of one warp", "12 nm",
       0.8, 623, 623, "", 0, instruction("alu", 2, 32), AccelWattch},
      {"a fused multiplication of fp32, the same", "12 nm", 0.8, 592, 592, "",
       0, instruction("fma", 2, 32), AccelWattch},
      {"an access of a lane to local memory, and 32 bits of a bank of 2 KiB",
       "22 nm",
       0.8,
       0.5,
       0.54,
       "",
       0,
       {{"local memory", "lane accesses", 1}},
       Cacti},
      {"a line of 64 bytes of the data cache, 16 KiB",
       "22 nm",
       0.8,
       7.5,
       14.1,
       "",
       0,
       {{"data cache", "hits", 1}},
       Cacti},
      {"the same",
       "7 nm",
       0.52,
       24,
       36,
       "",
       0,
       {{"data cache", "hits", 1}},
       Bytes},
      {"a pixel of 128 bits, in a bank of 4 KiB with a read and a write port",
       "22 nm",
       0.8,
       1.3,
       3.4,
       "pixel of the buffer",
       1,
       {},
       Cacti},
      {"a line of 64 bytes of the L2, 1 MiB",
       "22 nm",
       0.8,
       96,
       103,
       "",
       0,
       {{"l2", "line reads", 1}},
       Cacti},
      {"the same, of 512 KiB",
       "7 nm",
       0.52,
       151,
       169,
       "",
       0,
       {{"l2", "line reads", 1}},
       Bytes},
      {"a byte over 1 mm",
       "7 nm",
       0.485,
       0.30,
       0.42,
       "wire byte mm",
       1,
       {},
       Mesh},
      {"a line of 64 bytes read from DRAM, with its row",
       "LPDDR4",
       0.8,
       4350,
       4670,
       "",
       0,
       {{"dram", "read bursts", 2},
        {"dram", "activations", 1},
        {"dram channels", "lpddr4-3200", 1}},
       Dram},
      {"leakage of a mm2 of memory, mW",
       "22 nm",
       0.8,
       0.16,
       112,
       "leakage of a mm2",
       1,
       {},
       CactiLeaks},
      {"a bit of a memory of 32 KiB, um2",
       "22 nm",
       0,
       0.102,
       0.102,
       "SRAM bit",
       1,
       {},
       CactiArea},
      {"a bit of a bank with two ports, um2",
       "22 nm",
       0,
       0.223,
       0.223,
       "buffer bit",
       1,
       {},
       CactiArea},
  };
  return All;
}

std::string_view name(Beside B) {
  constexpr std::string_view Names[] = {"below", "within", "above"};
  return Names[size_t(B)];
}

Beside besideOf(const Estimate &Ours, const PublishedFigure &Theirs) {
  return Ours.High < Theirs.Low   ? Beside::Below
         : Ours.Low > Theirs.High ? Beside::Above
                                  : Beside::Within;
}

Expected<Estimate> oursOf(const PublishedFigure &Theirs, const Technology &T) {
  if (!Theirs.Row.empty()) {
    const auto Is = [&](const TechnologyRow &R) {
      return R.Name == Theirs.Row;
    };
    auto Row = std::ranges::find_if(T.Energies, Is);
    const bool IsEnergy = Row != T.Energies.end();
    if (!IsEnergy)
      Row = std::ranges::find_if(T.Areas, Is);
    const double ByVolts =
        IsEnergy ? (Theirs.Volts / T.Volts) * (Theirs.Volts / T.Volts) : 1;
    const double Value = Theirs.Count * Row->Value * ByVolts;
    // A log-normal has 90 % of its draws within so many sigma.
    constexpr double Sigmas = 1.645;
    const double Factor = std::exp(Sigmas * std::hypot(Row->Sigma, T.Sigma));
    return Estimate{Value, Value / Factor, Value * Factor};
  }
  // The clock only says for how long parts leak and DRAM stands.
  constexpr unsigned Mhz = 100;
  const auto Model = EnergyModel::create(T, Mhz, Theirs.Volts);
  if (!Model)
    return Model.error();
  const auto Made = Model->energyOf({1, Mhz, Theirs.Events});
  if (!Made)
    return Made.error();
  constexpr double Picojoules = 1e12;
  return Estimate{Picojoules * Made->Total.Value, Picojoules * Made->Total.Low,
                  Picojoules * Made->Total.High};
}

std::string publishedMarkdown(const Technology &T) {
  std::string Text = "| what | node | V | theirs, pJ | ours, pJ | ours by "
                     "theirs | ours is | theirs from |\n"
                     "|---|---|--:|--:|--:|--:|---|---|\n";
  for (const PublishedFigure &P : publishedFigures()) {
    const auto Range = [](double Low, double High, const char *Form) {
      const std::string First = fmt::format(fmt::runtime(Form), Low);
      const std::string Last = fmt::format(fmt::runtime(Form), High);
      return First == Last ? First : fmt::format("{} to {}", First, Last);
    };
    const auto Ours = oursOf(P, T);
    Text += fmt::format(
        "| {} | {} | {} | {} | {} | {} | {} | {} |\n", P.What, P.Node,
        P.Volts > 0 ? fmt::format("{:g}", P.Volts) : "",
        Range(P.Low, P.High, "{:g}"),
        Ours ? fmt::format("{:.3g} ({:.3g}-{:.3g})", Ours->Value, Ours->Low,
                           Ours->High)
             : "none",
        Ours ? Range(Ours->Value / P.High, Ours->Value / P.Low, "{:.2g}") : "",
        Ours ? name(besideOf(*Ours, P)) : "", P.Source);
  }
  return Text;
}

} // namespace vorion::isasim
