/// The part of vorion-compiler that is PoCL's: its front end and passes.
#pragma once

#include "devices/vorion/MachineCode.h"

#include <functional>
#include <string>
#include <string_view>

namespace vorion {

using MakeImage = std::function<MachineAnswer(const MachineRequest &)>;

/// The answer (CompilerMessages.h) to \p Request, as texts. \p TakePrinted
/// gives what was printed on standard error since it was called last. \p Root
/// is the folder of the installation. Nothing if \p Request is none. Sets \p
/// MayStay to whether the process may answer another one.
std::string answerProgramRequest(
    std::string_view Request, const std::string &Root, const MakeImage &Make,
    const std::function<std::string()> &TakePrinted, bool &MayStay);

} // namespace vorion
