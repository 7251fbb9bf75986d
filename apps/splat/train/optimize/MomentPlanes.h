/// Where Adam's moments lie: twice as much as the parameters.
#pragma once

#include "device/Launcher.h"

#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

namespace vorion::splat {

/// On the device, or on the host where the device has no room for them. Then
/// planes come to the device one at a time, for as long as it changes them. The
/// results have the same bits.
enum class MomentsOn { Device, Host };

constexpr std::string_view name(MomentsOn W) {
  return W == MomentsOn::Device ? "device" : "host";
}

/// Planes of one moment, of as many floats as there are Gaussians. Who has them
/// knows both numbers.
class MomentPlanes {
public:
  MomentPlanes() = default;
  /// Planes that lie on the device.
  MomentPlanes(cl::Buffer There) : OnDevice(std::move(There)) {}
  /// \p Values where \p Place says.
  MomentPlanes(Launcher &L, MomentsOn Place, std::vector<float> Values);

  MomentsOn areOn() const { return Where; }
  const cl::Buffer &onDevice() const { return OnDevice; }
  /// All \p Words of them.
  std::vector<float> values(Launcher &L, std::size_t Words) const;

  /// Changes the first \p Planes of \p Count floats in place. \p Do(Values,
  /// First, Number) is called with a buffer that has Number planes from plane
  /// First on: once, or for each plane.
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
  /// Changes plane \p P alone: \p Do(Values, At), where Values has it as its
  /// plane At.
  template <typename Work>
  void changePlane(Launcher &L, uint32_t Count, uint32_t P, Work Do) {
    if (Where == MomentsOn::Device)
      return Do(OnDevice, P);
    const cl::Buffer One = allocate(L, Count);
    bring(L, One, P, Count);
    Do(One, 0U);
    take(L, One, P, Count);
  }
  /// change() of two moments at once: \p Do(first, second, First, Number).
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
  /// \p Planes of \p NewCount floats at the same place, which \p Do(from, to,
  /// Number) makes of those here.
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
  /// Plane \p P to the device, and back.
  void bring(Launcher &L, const cl::Buffer &To, uint32_t P,
             uint32_t Count) const;
  void take(Launcher &L, const cl::Buffer &From, uint32_t P, uint32_t Count);

  MomentsOn Where = MomentsOn::Device;
  cl::Buffer OnDevice;
  std::vector<float> OnHost;
};

} // namespace vorion::splat
