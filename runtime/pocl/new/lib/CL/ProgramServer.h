/// The part of vorion-compiler that is PoCL's: its front end and passes.
#pragma once

#include "devices/vorion/MachineCode.h"

#include <functional>
#include <string>
#include <string_view>

namespace vorion {

/// A module of SPIR-V as bitcode.
struct Translation {
  std::string Bitcode;
  std::string Problem; ///< why there is none; for the build log
};

/// What comes before PoCL's part, and after it.
struct CompilerSteps {
  std::function<Translation(const std::string &)> Translate;
  std::function<MachineAnswer(const MachineRequest &)> MakeImage;
  std::function<MachineAnswer(const std::vector<NamedObject> &)> LinkObjects;
  std::function<bool(const std::vector<std::string> &)> AreOptions;
};

/// The answer (CompilerMessages.h) to \p Request, as texts. \p TakePrinted
/// gives what was printed on standard error since it was called last. \p Root
/// is the folder of the installation. Nothing if \p Request is none. Sets \p
/// MayStay to whether the process may answer another one.
std::string
answerProgramRequest(std::string_view Request, const std::string &Root,
                     const CompilerSteps &Steps,
                     const std::function<std::string()> &TakePrinted,
                     bool &MayStay);

} // namespace vorion
