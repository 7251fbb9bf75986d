/// A kernel program: a file of kernels/ and its build-time choices.
#pragma once

#include "device/OpenCl.h"

#include <cassert>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace vorion::splat {

/// One program: its kernel source, which includes what it uses, and the macros
/// it is built with. Made by the structures `Program` of the generated headers
/// (kernel_headers.py), which have a member for each choice of the file.
struct ProgramSpec {
  std::string File;                 ///< of kernels/, by which kernels are run
  std::vector<std::string> Defines; ///< "NAME" or "NAME=value"

  /// The name in messages and reports: the file name without ".cl".
  std::string name() const { return File.substr(0, File.rfind('.')); }

  bool operator==(const ProgramSpec &) const = default;
};

/// The choice of an effect's code in a program.
class EffectSwitch {
public:
  static EffectSwitch absent() { return EffectSwitch("0"); }
  static EffectSwitch compiled() { return EffectSwitch("1"); }
  /// Compiled, and executed if \p Bit of the kernels' variable `effects` is
  /// set.
  static EffectSwitch flagged(uint32_t Bit);

  const std::string &text() const { return Text; }

private:
  explicit EffectSwitch(std::string TextIn) : Text(std::move(TextIn)) {}
  std::string Text; ///< in OpenCL C
};

/// Collects a program's choices as macros. An unset choice is not defined.
class ChoiceDefines {
public:
  void add(const char *Name, bool Value);
  void add(const char *Name, const std::optional<cl_uint> &Value);
  void add(const char *Name, const std::optional<cl_float> &Value);
  void add(const char *Name, const std::optional<EffectSwitch> &Value);
  /// Adds a choice without which the file does not compile.
  template <typename T>
  void require(const char *Name, const std::optional<T> &Value) {
    assert(Value && "a choice of this program is not made");
    add(Name, Value);
  }
  std::vector<std::string> take() { return std::move(Defines); }

private:
  std::vector<std::string> Defines;
};

} // namespace vorion::splat
