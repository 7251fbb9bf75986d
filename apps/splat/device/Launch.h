/// What the generated launches of kernels are made of (kernel_headers.py).
#pragma once

#include "device/OpenCl.h"

#include <concepts>
#include <optional>
#include <utility>

namespace vorion::splat {

/// One argument of a launch. It is made of a value of exactly the kernel's
/// type, and there is none without a value: a wrong argument does not compile,
/// nor does a missing one.
template <typename T> class Argument {
public:
  // NOLINTNEXTLINE(google-explicit-constructor): a launch lists values.
  template <std::same_as<T> U> Argument(U Given) : Value(std::move(Given)) {}

  const T &value() const { return Value; }

private:
  T Value;
};

/// An argument of a kernel that has it only where its program makes a choice;
/// OpenCL refuses a launch that gives it elsewhere, or lacks it there.
template <typename T> using ArgumentByChoice = std::optional<Argument<T>>;

/// A structure of a kernel's arguments that names the kernel.
template <typename T>
concept KernelLaunch = requires(const T &Launch) {
  { T::ProgramFile } -> std::convertible_to<const char *>;
  { T::KernelName } -> std::convertible_to<const char *>;
  Launch.arguments();
};

} // namespace vorion::splat
