/// Storage of Adam's moments, whose size is twice that of the parameters.
#pragma once

#include "device/Launcher.h"

#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

namespace vorion::splat {

/// In device memory, or on the host if they do not fit. Planes on the host are
/// copied to the device one at a time to be updated. Results are bit-identical.
enum class MomentsOn { Device, Host };

constexpr std::string_view name(MomentsOn W) {
  return W == MomentsOn::Device ? "device" : "host";
}

/// Planes of one moment, with one float per Gaussian. The owner knows the
/// numbers of planes and Gaussians.
class MomentPlanes {
public:
  MomentPlanes() = default;
  /// Planes on the device.
  MomentPlanes(cl::Buffer There) : OnDevice(std::move(There)) {}
  /// \p Values in the memory \p Place.
  MomentPlanes(Launcher &L, MomentsOn Place, std::vector<float> Values);

  MomentsOn areOn() const { return Where; }
  const cl::Buffer &onDevice() const { return OnDevice; }
  /// All values, \p Words floats.
  std::vector<float> values(Launcher &L, std::size_t Words) const;

  /// Updates the first \p Planes planes of \p Count floats in place. \p
  /// Do(Values, First, Number) is called, once or for each plane, with a buffer
  /// of Number planes from plane First on.
  template <typename Work>
  void change(Launcher &L, uint32_t Count, uint32_t Planes, Work Do) {
    if (Where == MomentsOn::Device)
      return Do(OnDevice, 0U, Planes);
    const cl::Buffer One = allocate(L, Count);
    for (uint32_t P = 0; P != Planes; ++P) {
      bring(L, One, P, Count);
      Do(One, P, 1U);
      take(L, One, P, Count);
    }
  }
  /// Updates only plane \p P, by \p Do(Values, At), where it is plane At of
  /// Values.
  template <typename Work>
  void changePlane(Launcher &L, uint32_t Count, uint32_t P, Work Do) {
    if (Where == MomentsOn::Device)
      return Do(OnDevice, P);
    const cl::Buffer One = allocate(L, Count);
    bring(L, One, P, Count);
    Do(One, 0U);
    take(L, One, P, Count);
  }
  /// change() for two moments at once: \p Do(first, second, First, Number).
  template <typename Work>
  static void changeBoth(Launcher &L, MomentPlanes &A, MomentPlanes &B,
                         uint32_t Count, uint32_t Planes, Work Do) {
    if (A.Where == MomentsOn::Device)
      return Do(A.OnDevice, B.OnDevice, 0U, Planes);
    const cl::Buffer OfA = allocate(L, Count);
    B.change(L, Count, Planes,
             [&](const cl::Buffer &OfB, uint32_t P, uint32_t Number) {
               A.bring(L, OfA, P, Count);
               Do(OfA, OfB, P, Number);
               A.take(L, OfA, P, Count);
             });
  }
  /// Creates \p Planes planes of \p NewCount floats in the same memory, by \p
  /// Do(from, to, Number).
  template <typename Work>
  MomentPlanes remade(Launcher &L, uint32_t Count, uint32_t Planes,
                      uint32_t NewCount, Work Do) const {
    if (Where == MomentsOn::Device) {
      MomentPlanes New(allocate(L, std::size_t{NewCount} * Planes));
      Do(OnDevice, New.OnDevice, Planes);
      return New;
    }
    MomentPlanes New(L, Where,
                     std::vector<float>(std::size_t{NewCount} * Planes));
    const cl::Buffer From = allocate(L, Count), To = allocate(L, NewCount);
    for (uint32_t P = 0; P != Planes; ++P) {
      bring(L, From, P, Count);
      Do(From, To, 1U);
      New.take(L, To, P, NewCount);
    }
    return New;
  }

private:
  static cl::Buffer allocate(Launcher &L, std::size_t Words);
  /// Copies plane \p P to the device, and back.
  void bring(Launcher &L, const cl::Buffer &To, uint32_t P,
             uint32_t Count) const;
  void take(Launcher &L, const cl::Buffer &From, uint32_t P, uint32_t Count);

  MomentsOn Where = MomentsOn::Device;
  cl::Buffer OnDevice;
  std::vector<float> OnHost;
};

} // namespace vorion::splat
