/// Lines about what happens, by category (docs/trace-format.md).
#pragma once

#include "vorion/isasim/Observer.h"
#include "vorion/support/Expected.h"

#include <cstdio>
#include <string>
#include <string_view>
#include <unordered_map>

namespace vorion::isasim {

/// What `--trace` asks for.
struct TraceRequest {
  /// One bit for each line of TraceCategories.def.
  uint32_t Categories = 0;
  std::string File; ///< empty for stderr

  /// "cat,cat[:FILE]"; "all" stands for every category.
  static Expected<TraceRequest> parse(std::string_view Text);
};

class Trace : public Observer {
public:
  /// Writes to \p OutIn, which must outlive the trace; the header at once.
  Trace(std::FILE *OutIn, uint32_t CategoriesIn);

  void runBegins(const RunStart &R) override;
  void commit(const Commit &C) override;
  void syncPoint(std::span<const std::unique_ptr<Core>> Cores) override;
  void rasterCommand(const raster::CommandWork &W) override;
  void tail(const raster::TailWork &W) override;
  void trap(const Trap &T) override;
  void runEnds(const RunResult &R) override;

private:
  enum class Category : unsigned;
  bool wants(Category C) const {
    return Categories >> static_cast<unsigned>(C) & 1;
  }

  /// What is the same each time that an instruction executes.
  struct Texts {
    std::string Place, Instruction;
  };
  const Texts &textsOf(const Step &S);

  std::FILE *Out;
  uint32_t Categories;
  std::shared_ptr<const Image> Program;
  unsigned CoresPerSocket = 1, CoresPerCluster = 1;
  std::unordered_map<uint32_t, Texts> ByPc; ///< of the program
  uint64_t Runs = 0, SyncPoints = 0;
};

} // namespace vorion::isasim
