/// Tells of what happens in the memory system, in cycles of the chip.
#pragma once

#include "timing/common/TimeObserver.h"
#include "timing/memory/L2Link.h"

namespace vorion::isasim {

class MemoryWatch {
public:
  /// \p LinkIn is null where the chip's cycles are those of the L2.
  MemoryWatch(const TimeWatch &ObserversIn, const L2Link *LinkIn)
      : Observers(ObserversIn), Link(LinkIn) {}

  // As of TimeObserver; spans are in cycles of the L2.
  void bankBusy(BankPlace Where, CycleSpan When) const {
    Observers.tell([&](TimeObserver &O) { O.bankBusy(Where, toChip(When)); });
  }
  void dramRequest(unsigned Channel, uint32_t Address, bool IsWrite) const {
    Observers.tell(
        [&](TimeObserver &O) { O.dramRequest(Channel, Address, IsWrite); });
  }
  void dramCommand(unsigned Channel, const dram::Issued &What,
                   CycleSpan Data) const {
    Observers.tell(
        [&](TimeObserver &O) { O.dramCommand(Channel, What, toChip(Data)); });
  }

private:
  CycleSpan toChip(CycleSpan When) const {
    return Link ? CycleSpan{Link->toChip(When.From), Link->toChip(When.Until)}
                : When;
  }

  const TimeWatch &Observers;
  const L2Link *Link;
};

} // namespace vorion::isasim
