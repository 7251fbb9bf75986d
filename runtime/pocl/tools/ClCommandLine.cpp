#include "ClCommandLine.h"

#include "vorion/support/Suggest.h"

#include <algorithm>
#include <array>
#include <regex.h>
#include <set>

namespace vorion {

namespace {

Error usageError(std::string What) {
  return {"", std::move(What), ExitCode::Usage};
}

/// -DNAME, -DNAME=TEXT or -DNAME(ARGUMENTS)=TEXT as a line of OpenCL C. Like
/// clang's, the definition ends with its first line.
std::string defineLine(std::string Macro) {
  Macro.resize(std::min(Macro.find('\n'), Macro.size()));
  const size_t Equals = Macro.find('=');
  if (Equals == std::string::npos)
    return "#define " + Macro + " 1\n";
  return "#define " + Macro.substr(0, Equals) + " " + Macro.substr(Equals + 1) +
         "\n";
}

/// -W... as a pragma, since OpenCL's build options have none but -w and
/// -Werror.
std::string warningLine(const std::string &Name) {
  const auto Pragma = [](const char *Level, const std::string &Group) {
    return std::string("#pragma clang diagnostic ") + Level + " \"-W" + Group +
           "\"\n";
  };
  if (Name.starts_with("no-error="))
    return Pragma("warning", Name.substr(9));
  if (Name.starts_with("no-"))
    return Pragma("ignored", Name.substr(3));
  if (Name.starts_with("error="))
    return Pragma("error", Name.substr(6));
  return Pragma("warning", Name);
}

/// -Wl,... and its like are for other programs; the rest are names of warnings.
bool isWarningName(const std::string &Name) {
  return !Name.empty() &&
         Name.find_first_not_of("abcdefghijklmnopqrstuvwxyz"
                                "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-+=#") ==
             std::string::npos;
}

/// Options without effect: kernels are compiled with -O2 in the end unless told
/// -O0, and warnings are no errors unless told so.
const std::set<std::string> Ignored = {"-O",  "-O1", "-O2", "-O3",
                                       "-Os", "-Oz", "-g0", "-Wno-error"};

/// OpenCL C's options that are handed on.
const std::set<std::string> OpenClOptions = {
    "-cl-denorms-are-zero",
    "-cl-fast-relaxed-math",
    "-cl-finite-math-only",
    "-cl-fp32-correctly-rounded-divide-sqrt",
    "-cl-kernel-arg-info",
    "-cl-mad-enable",
    "-cl-no-signed-zeros",
    "-cl-opt-disable",
    "-cl-single-precision-constant",
    "-cl-std=CL1.1",
    "-cl-std=CL1.2",
    "-cl-std=CL3.0",
    "-cl-strict-aliasing",
    "-cl-unsafe-math-optimizations"};

/// What is wrong with a pattern for remarks. Empty: nothing.
std::string wrongPattern(const std::string &Pattern) {
  regex_t Compiled;
  const int Code = regcomp(&Compiled, Pattern.c_str(), REG_EXTENDED);
  if (Code == 0) {
    regfree(&Compiled);
    return {};
  }
  std::array<char, 128> Text{};
  regerror(Code, &Compiled, Text.data(), Text.size());
  return Text.data();
}

/// Refuses \p Option, with the one that was meant if there is one like it.
Error unknownOption(const std::string &Option) {
  const std::string Language = "-cl-std=";
  if (Option.starts_with(Language)) {
    std::string Offered;
    for (const std::string &Known : OpenClOptions)
      if (Known.starts_with(Language))
        Offered +=
            (Offered.empty() ? "" : ", ") + Known.substr(Language.size());
    return usageError(Option + ": unsupported language, expected one of " +
                      Offered);
  }
  std::vector<std::string> Known = {"-o",
                                    "-D",
                                    "-U",
                                    "-I",
                                    "-g",
                                    "-w",
                                    "-W",
                                    "-O0",
                                    "-Ofast",
                                    "-Werror",
                                    "-ffast-math",
                                    "-save-temps",
                                    "-v",
                                    "-mllvm",
                                    "-march=",
                                    "-Rpass=",
                                    "-Rpass-missed=",
                                    "-Rpass-analysis=",
                                    "--help",
                                    "--resources",
                                    "--version"};
  Known.insert(Known.end(), Ignored.begin(), Ignored.end());
  Known.insert(Known.end(), OpenClOptions.begin(), OpenClOptions.end());
  // An option's value is no part of its name.
  const std::string Name = Option.substr(0, Option.find('=') + 1);
  std::string_view Meant = closestTo(Option, Known);
  if (Meant.empty() && !Name.empty())
    Meant = closestTo(Name, Known);
  return usageError(Option + ": unknown option, " +
                    (Meant.empty()
                         ? "expected one that vorion-clang --help lists"
                         : "did you mean " + std::string(Meant) + "?"));
}

} // namespace

bool isSpirv(const std::filesystem::path &Input) {
  return Input.extension() == ".spv";
}

Expected<std::string> includeOption(const std::string &Folder) {
  if (Folder.find('"') != std::string::npos)
    return Error{Folder, "has a double quote in its name, expected a folder "
                         "that OpenCL's build options can name"};
  return "-I\"" + Folder + "\" ";
}

Expected<ClCommandLine>
parseClCommandLine(const std::vector<std::string> &Arguments) {
  ClCommandLine Line;
  bool KeepsBesideOutput = false;
  for (size_t I = 0; I < Arguments.size(); ++I) {
    const std::string &Argument = Arguments[I];
    if (!Argument.starts_with("-")) {
      if (std::filesystem::path(Argument).extension() != ".cl" &&
          !isSpirv(Argument))
        return usageError(Argument + ": expected a .cl or .spv file");
      Line.Inputs.emplace_back(Argument);
      continue;
    }
    const std::string Letter = Argument.substr(0, 2);
    if (Letter == "-o" || Letter == "-D" || Letter == "-U" || Letter == "-I") {
      std::string Value = Argument.substr(2);
      if (Value.empty() && ++I < Arguments.size())
        Value = Arguments[I];
      if (Value.empty())
        return usageError(Letter + ": missing value, expected a " +
                          (Letter == "-o"   ? "file name"
                           : Letter == "-I" ? "folder"
                                            : "macro"));
      if (Letter == "-o") {
        Line.Output = Value;
      } else if (Letter == "-D") {
        Line.Prelude += defineLine(Value);
      } else if (Letter == "-U") {
        Line.Prelude += "#undef " + Value + "\n";
      } else {
        Expected<std::string> Option = includeOption(Value);
        if (!Option)
          return Option.error();
        Line.BuildOptions += *Option;
      }
    } else if (Ignored.contains(Argument)) {
      continue;
    } else if (Argument == "-g" || Argument == "-g1" || Argument == "-g2" ||
               Argument == "-g3") {
      Line.BuildOptions += "-g ";
    } else if (Argument == "-O0") {
      Line.BuildOptions += "-cl-opt-disable ";
    } else if (Argument == "-Ofast" || Argument == "-ffast-math") {
      Line.BuildOptions += "-cl-fast-relaxed-math ";
    } else if (Argument == "-v") {
      Line.Verbose = true;
    } else if (Argument == "-save-temps" || Argument == "-save-temps=cwd") {
      Line.Temporaries = ".";
    } else if (Argument == "-save-temps=obj") {
      KeepsBesideOutput = true;
    } else if (Argument.starts_with("-save-temps=")) {
      return usageError(Argument + ": unknown location, expected cwd or obj");
    } else if (Argument == "-w" || Argument == "-Werror" ||
               OpenClOptions.contains(Argument)) {
      Line.BuildOptions += Argument + " ";
    } else if (Argument.starts_with("-Rpass=") ||
               Argument.starts_with("-Rpass-missed=") ||
               Argument.starts_with("-Rpass-analysis=")) {
      const std::string Wrong =
          wrongPattern(Argument.substr(Argument.find('=') + 1));
      if (!Wrong.empty())
        return usageError(
            std::string(Argument).append(": ").append(Wrong).append(
                ", expected a regular expression"));
      Line.ForMachine.push_back(Argument);
    } else if (Argument == "--start-no-unused-arguments" ||
               Argument == "--end-no-unused-arguments") {
      // clang's. Here no option is unused.
    } else if (Argument == "-mllvm") {
      ++I;
      if (I == Arguments.size())
        return usageError("-mllvm: expected an LLVM option");
      for (const std::string &Word : {Argument, Arguments[I]}) {
        Line.ForMachine.push_back(Word);
        Line.ToCheck.push_back(Word);
      }
    } else if (Argument.starts_with("-march=")) {
      Line.ForMachine.push_back(Argument);
      Line.ToCheck.push_back(Argument);
    } else if (Letter == "-W" && isWarningName(Argument.substr(2))) {
      Line.Prelude += warningLine(Argument.substr(2));
    } else {
      return unknownOption(Argument);
    }
  }
  if (Line.Inputs.empty())
    return usageError("no input, expected a .cl or .spv file");
  if (Line.Output.empty())
    Line.Output = Line.Inputs[0].filename().replace_extension(".elf");
  if (KeepsBesideOutput)
    Line.Temporaries = Line.Output.parent_path();
  return Line;
}

} // namespace vorion
