/// The checkers that `--check` asks for, and what they share.
#pragma once

#include "observe/check/Findings.h"
#include "observe/check/Places.h"
#include "vorion/support/Expected.h"

#include <memory>
#include <string_view>
#include <vector>

namespace vorion::isasim {

class UninitCheck;

/// An observer itself: told before its checkers, it sets up what they share.
class Checkers : public Observer {
public:
  /// \p Names: some of Checks.def apart by commas, or "all". \p Say receives
  /// reports.
  static Expected<std::unique_ptr<Checkers>>
  create(std::string_view Names, std::function<void(std::string_view)> Say);
  ~Checkers() override;

  /// This and all checkers, in the order in which they are to be told.
  std::vector<Observer *> observers();

  // What the driver does, between runs.
  void allocated(uint32_t Address, uint64_t Bytes, std::string Name);
  void released(uint32_t Address) { Where.Held.remove(Address); }
  void written(uint32_t Address, uint64_t Bytes);
  void rename(uint32_t Address, std::string Name) {
    Where.Held.rename(Address, std::move(Name));
  }
  void useLocal(uint64_t Bytes) { Where.LocalUsed = Bytes; }
  /// Bytes to leave free behind each buffer, so that what runs over its end
  /// does not reach the next one.
  uint64_t guardBytes() const { return GuardsWanted ? 4096 : 0; }

  uint64_t findings() const { return Found.count(); }

  void runBegins(const RunStart &R) override;
  void runEnds(const RunResult &R) override;

private:
  explicit Checkers(std::function<void(std::string_view)> Say)
      : Found(std::move(Say)) {}

  Findings Found;
  Places Where;
  std::vector<std::unique_ptr<Observer>> Each;
  UninitCheck *Uninit = nullptr; ///< one of them
  bool GuardsWanted = false;
};

} // namespace vorion::isasim
