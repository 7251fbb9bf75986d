/// Images and samplers as kernels see them (libdevice/opencl/image.cl).
#pragma once

#include "vorion.h"

#include <vorion/runtime.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace vorion {

/// Says which images the device offers, and how large they can be.
void describeImages(cl_device_id Device);

/// The bytes from one row of an image to the next; the rows of a 1D array are
/// its layers.
size_t rowPitch(const _cl_mem &Image);

/// Where an image begins in the memory of the buffer that it is made of; 0 of
/// any other memory object.
size_t beginInBuffer(const _cl_mem &Memory);

/// What an argument of type sampler_t is.
uint32_t samplerValue(const pocl_argument &Argument);

/// The descriptions of a launch's images. They are in device memory as long as
/// this lives.
class ImageDescriptions {
public:
  explicit ImageDescriptions(vx_device *Device) : Device(Device) {}
  ~ImageDescriptions();
  ImageDescriptions(const ImageDescriptions &) = delete;
  ImageDescriptions &operator=(const ImageDescriptions &) = delete;

  /// The address that the kernel is given, or nothing if there is no memory.
  std::optional<uint32_t> add(pocl_argument &Argument, cl_device_id OpenCl);

private:
  vx_device *Device;
  std::vector<uint32_t> Addresses;
};

} // namespace vorion
