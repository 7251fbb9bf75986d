/// One command in the works that may hand batches over.
#pragma once

#include "raster/WorkLog.h"

#include <optional>
#include <utility>
#include <vector>

namespace vorion::raster {

class BatchRun {
public:
  virtual ~BatchRun() = default;
  BatchRun(const BatchRun &) = delete;
  BatchRun &operator=(const BatchRun &) = delete;

  /// Goes on, to the next batch or for a stretch of the list: the batch, or
  /// nothing if there is none yet or the command fails. Not once isDone().
  virtual std::optional<Batch> next() = 0;
  /// Whether there is nothing left to do.
  virtual bool isDone() const = 0;

  /// What is known of a command that is not done.
  const CommandWork &begun() const { return Work; }
  /// What next() has fetched.
  std::vector<GaussianWork> takeFetched() {
    return std::exchange(Work.Gaussians, {});
  }
  /// What has been done, once isDone().
  CommandWork takeWork() { return std::move(Work); }

protected:
  explicit BatchRun(CommandWork Begun) : Work(std::move(Begun)) {}

  CommandWork Work;
  const Job &Task = Work.What;
};

} // namespace vorion::raster
