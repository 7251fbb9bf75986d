/// The checkers that `--check` asks for, and what they share.
#pragma once

#include "observe/check/Check.h"
#include "vorion/support/Expected.h"

#include <memory>
#include <string_view>
#include <vector>

namespace vorion::isasim {

/// An observer itself: told before its checkers, it sets up what they share.
class Checkers : public Observer {
public:
  /// \p Names: some of Checks.def apart by commas, or "all". \p Report receives
  /// reports.
  static Expected<std::unique_ptr<Checkers>>
  create(std::string_view Names, std::function<void(std::string_view)> Report);

  /// This and all checkers, in the order in which they are to be told.
  std::vector<Observer *> observers();

  /// Bytes to leave free behind each buffer.
  uint64_t guardBytes() const;
  uint64_t findings() const { return Reports.count(); }

  void allocated(uint32_t Address, uint64_t Bytes,
                 const std::string &Name) override {
    Where.Held.add(Address, Bytes, Name);
  }
  void released(uint32_t Address) override { Where.Held.remove(Address); }
  void bufferNamed(uint32_t Address, const std::string &Name) override {
    Where.Held.rename(Address, Name);
  }
  void localUsed(uint64_t Bytes) override { Where.LocalUsed = Bytes; }
  void runBegins(const RunStart &R) override;
  void runEnds(const RunResult &R) override;

private:
  explicit Checkers(std::function<void(std::string_view)> Report)
      : Reports(std::move(Report)) {}

  Findings Reports;
  Places Where;
  std::vector<std::unique_ptr<Check>> Checks;
};

} // namespace vorion::isasim
