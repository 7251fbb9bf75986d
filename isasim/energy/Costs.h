/// Which rows of a technology an event of a time report is worth, and which a
/// part of the machine is made of.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace vorion::isasim {

/// What energies are added up by.
enum class EnergyUnit : uint8_t {
  FrontEnd,
  Registers,
  Arithmetic,
  LoadStore,
  LocalMemory,
  CoreClock,
  RasterLanes,
  RasterBuffers,
  RasterClock,
  PixelUnit,
  Wires,
  Leakage,
  Link,
  L2,
  Llc,
  Host,
  Dram,
  Count
};
std::string_view name(EnergyUnit U);
/// Of the chip. The paper's has no L2, no cache behind it and no units of the
/// host: those are at the other end of its link. Without a link they are on the
/// chip.
constexpr bool isOnChip(EnergyUnit U, bool HasLink) {
  return U < EnergyUnit::Link ||
         (!HasLink && (U == EnergyUnit::L2 || U == EnergyUnit::Llc ||
                       U == EnergyUnit::Host));
}

/// An event is worth \c Count times a row. An event that is worth several rows
/// has a cost for each.
struct EventCost {
  std::string_view Unit, Event;
  EnergyUnit Of;
  std::string_view Row;
  double Count;
};
std::span<const EventCost> eventCosts();

/// Events of the activities that are worth nothing beside what others are.
struct FreeEvent {
  std::string_view Unit, Event;
};
std::span<const FreeEvent> freeEvents();

/// A part is made of \c Count times a row for each of what \c Event of the
/// activities' unit "time" counts.
struct AreaCost {
  std::string_view Part, Event, Row;
  double Count;
  EnergyUnit LeaksAs = EnergyUnit::Leakage;
};
std::span<const AreaCost> areaCosts();

/// \name Rows that a technology has to have
/// @{
std::span<const std::string_view> energyRows();
std::span<const std::string_view> areaRows();
/// @}

} // namespace vorion::isasim
