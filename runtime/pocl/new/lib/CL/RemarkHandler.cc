//===- RemarkHandler.cc - what passes in PoCL tell of their decisions -----===//

#include "RemarkHandler.h"

#include "vorion/support/Environment.h"

#include <llvm/IR/DiagnosticInfo.h>
#include <llvm/IR/DiagnosticPrinter.h>
#include <llvm/Support/Regex.h>

#include <cstdio>
#include <iomanip>
#include <optional>
#include <sstream>
#include <string>

using namespace llvm;

namespace pocl {

namespace {

/// The last pattern of VORION_REMARKS. The machine's compiler tells what is
/// wrong with one.
std::optional<Regex> wantedRemarks() {
  const char *Options = vorion::environmentVariable("VORION_REMARKS");
  std::istringstream Words(Options ? Options : "");
  std::optional<Regex> Wanted;
  for (std::string Word; Words >> std::quoted(Word);)
    if (StringRef Option = Word; Option.consume_front("-Rpass-missed="))
      Wanted.emplace(Option);
  std::string Problem;
  if (Wanted && !Wanted->isValid(Problem))
    Wanted.reset();
  return Wanted;
}

class RemarkHandler : public DiagnosticHandler {
public:
  explicit RemarkHandler(DiagnosticPrinter &Log)
      : Log(Log), Missed(wantedRemarks()) {}

  bool handleDiagnostics(const DiagnosticInfo &Told) override {
    // clang, which uses the context before, leaves LLVM's own check turned off.
    if (const auto *Any = dyn_cast<DiagnosticInfoOptimizationBase>(&Told);
        Any && !Any->isEnabled())
      return true;
    if (const auto *Remark = dyn_cast<OptimizationRemarkMissed>(&Told))
      std::fprintf(stderr, "%s: remark: %s [-Rpass-missed=%s]\n",
                   Remark->getLocationStr().c_str(), Remark->getMsg().c_str(),
                   Remark->getPassName().str().c_str());
    else
      Told.print(Log);
    return true;
  }

  bool isMissedOptRemarkEnabled(StringRef Pass) const override {
    return Missed && Pass.starts_with("vorion-") && Missed->match(Pass);
  }
  bool isAnalysisRemarkEnabled(StringRef /*Pass*/) const override {
    return false;
  }
  bool isPassedOptRemarkEnabled(StringRef /*Pass*/) const override {
    return false;
  }
  bool isAnyRemarkEnabled() const override { return Missed.has_value(); }

private:
  DiagnosticPrinter &Log;
  const std::optional<Regex> Missed;
};

} // namespace

std::unique_ptr<DiagnosticHandler> createRemarkHandler(DiagnosticPrinter &Log) {
  return std::make_unique<RemarkHandler>(Log);
}

} // namespace pocl
