/// The building blocks of the generated kernel launches (kernel_headers.py).
#pragma once

#include "device/OpenCl.h"

#include <concepts>
#include <optional>
#include <utility>

namespace vorion::splat {

/// One argument of a launch. It converts only from a value of exactly the
/// kernel's type and has no default, so that neither a wrong nor a missing
/// argument compiles.
template <typename T> class Argument {
public:
  // NOLINTNEXTLINE(google-explicit-constructor): a launch lists values.
  template <std::same_as<T> U> Argument(U Given) : Value(std::move(Given)) {}

  const T &value() const { return Value; }

private:
  T Value;
};

/// An argument that a kernel has only under a build-time choice. OpenCL rejects
/// a launch that sets it without the choice, or omits it with the choice.
template <typename T> using ArgumentByChoice = std::optional<Argument<T>>;

/// A structure of a kernel's arguments that names the kernel.
template <typename T>
concept KernelLaunch = requires(const T &Launch) {
  { T::ProgramFile } -> std::convertible_to<const char *>;
  { T::KernelName } -> std::convertible_to<const char *>;
  Launch.arguments();
};

} // namespace vorion::splat
