/// A program image in the hands of a device.
#pragma once

#include "vorion/isasim/Image.h"
#include "vorion/isasim/Machine.h"

#include <memory>
#include <optional>
#include <vector>

namespace vorion::runtime {

/// A program and its writable data, which outlive the machine's image range
/// being given to another program. Owned by the device's user; used under the
/// device's lock.
class LoadedImage {
public:
  explicit LoadedImage(std::shared_ptr<const isasim::Image> Program)
      : Program(std::move(Program)) {}

  const isasim::Image &program() const { return *Program; }

  /// Puts the program into \p Machine with the data that saveFrom() kept, or
  /// its initial data the first time.
  void restoreInto(isasim::Machine &Machine);
  /// Keeps what the program's data is now; it must be the loaded one.
  void saveFrom(const isasim::Machine &Machine);

private:
  std::shared_ptr<const isasim::Image> Program;
  /// What saveFrom() kept last.
  std::optional<std::vector<std::byte>> Data;
};

} // namespace vorion::runtime
