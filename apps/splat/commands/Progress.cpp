#include "commands/Progress.h"

#include "device/Launcher.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/StatusLine.h"
#include "vorion/support/Terminal.h"

#include <chrono>
#include <fmt/format.h>
#include <memory>
#include <utility>

namespace vorion::splat {
namespace {

bool Hidden = false;

using Clock = std::chrono::steady_clock;

double seconds(Clock::duration D) {
  return std::chrono::duration<double>(D).count();
}

/// Views are drawn one after the other, each with one blend, or one is prepared
/// while another is blended: a view is drawn once its blend is over.
class ViewProgress {
public:
  explicit ViewProgress(std::size_t Views) : Views(Views) {}

  void enter(std::string_view Doing) {
    if (Blends) {
      if (++Drawn == 1)
        FirstDrawn = Clock::now();
      if (!canOverwrite())
        sayLine();
    }
    Blends = Doing == name(Stage::Blend);
    // What is read back was drawn before.
    const std::size_t View = Drawn + (Doing == name(Stage::ReadBack) ? 0 : 1);
    showStatus(fmt::format("splat: {} view {} of {}: {} ...{}",
                           barText(Drawn, Views), View, Views, Doing, left()));
  }

private:
  std::string left() const {
    // The first view waits for kernels to be compiled.
    return Drawn == 0 ? ""
                      : timeLeftText(seconds(Clock::now() - FirstDrawn),
                                     Drawn - 1, Views - 1);
  }
  void sayLine() {
    constexpr double Every = 10; // seconds
    if (Drawn == Views || seconds(Clock::now() - LastLine) < Every)
      return;
    LastLine = Clock::now();
    printNote(fmt::format("splat: {} of {} views{}\n", Drawn, Views, left()));
  }

  std::size_t Views, Drawn = 0;
  bool Blends = false;
  Clock::time_point FirstDrawn, LastLine = Clock::now();
};

class PartProgress {
public:
  explicit PartProgress(std::string What) : What(std::move(What)) {}

  void show(std::size_t Done, std::size_t All) {
    const auto Now = Clock::now();
    const double Every = canOverwrite() ? 0.1 : 10; // seconds
    if (seconds(Now - Last) < Every)
      return;
    Last = Now;
    const std::string Text =
        All == 0 ? fmt::format("{}: {}", What, Done)
                 : fmt::format("{}: {} of {}{}", What, Done, All,
                               timeLeftText(seconds(Now - First), Done, All));
    if (canOverwrite())
      showStatus(fmt::format("splat: {}{} ...",
                             All == 0 ? "" : barText(Done, All) + " ", Text));
    else
      printNote(fmt::format("splat: {}\n", Text));
  }

private:
  std::string What;
  Clock::time_point First = Clock::now(), Last = First;
};

} // namespace

void hideProgress() { Hidden = true; }

bool isProgressHidden() { return Hidden; }

std::function<void(std::string_view)> progress() {
  if (Hidden || !canOverwrite())
    return {};
  return [](std::string_view Stage) {
    showStatus(fmt::format("splat: {} ...", Stage));
  };
}

std::function<void(std::string_view)> progressOf(std::size_t Views) {
  if (Hidden || Views < 2)
    return progress();
  return [P = std::make_shared<ViewProgress>(Views)](std::string_view Stage) {
    P->enter(Stage);
  };
}

std::function<void(std::size_t, std::size_t)>
progressOfParts(const std::string &What) {
  if (Hidden)
    return [](std::size_t, std::size_t) {};
  return [P = std::make_shared<PartProgress>(What)](
             std::size_t Done, std::size_t All) { P->show(Done, All); };
}

} // namespace vorion::splat
