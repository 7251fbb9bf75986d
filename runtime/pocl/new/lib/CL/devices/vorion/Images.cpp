#include "Images.h"

extern "C" {
#include "common.h"
#include "pocl_image_util.h"
#include "pocl_util.h"
}

#include <array>
#include <cstddef>
#include <cstring>

namespace vorion {

namespace {

constexpr std::array Types = {
    CL_SNORM_INT8,     CL_SNORM_INT16,    CL_UNORM_INT8,   CL_UNORM_INT16,
    CL_SIGNED_INT8,    CL_SIGNED_INT16,   CL_SIGNED_INT32, CL_UNSIGNED_INT8,
    CL_UNSIGNED_INT16, CL_UNSIGNED_INT32, CL_HALF_FLOAT,   CL_FLOAT};
constexpr std::array Orders = {CL_R, CL_RG, CL_RGBA};
/// Of the types without integers alone.
constexpr std::array Greys = {CL_INTENSITY, CL_LUMINANCE};
constexpr std::array GreyTypes = {CL_SNORM_INT8,  CL_SNORM_INT16, CL_UNORM_INT8,
                                  CL_UNORM_INT16, CL_HALF_FLOAT,  CL_FLOAT};
/// Of CL_UNORM_INT8 alone.
constexpr std::array OrdersOfBytes = {CL_BGRA, CL_sRGBA, CL_sBGRA};
/// Behind all others, because only 2D images and their arrays have depths.
constexpr std::array<cl_image_format, 2> Depths = {
    {{CL_DEPTH, CL_UNORM_INT16}, {CL_DEPTH, CL_FLOAT}}};

/// The standard demands a quarter of these.
constexpr auto Formats = [] {
  std::array<cl_image_format, Orders.size() * Types.size() +
                                  Greys.size() * GreyTypes.size() +
                                  OrdersOfBytes.size() + Depths.size()>
      All{};
  size_t Count = 0;
  const auto Add = [&](const auto &Orders, const auto &Types) {
    for (const int Order : Orders)
      for (const int Type : Types)
        All[Count++] = {static_cast<cl_channel_order>(Order),
                        static_cast<cl_channel_type>(Type)};
  };
  Add(Orders, Types);
  Add(Greys, GreyTypes);
  Add(OrdersOfBytes, std::array{CL_UNORM_INT8});
  for (const cl_image_format &Depth : Depths)
    All[Count++] = Depth;
  return All;
}();

/// PoCL's description has the host's pointer, the device's an address of 32
/// bits. The fields behind it are the same.
constexpr size_t FieldsBegin = offsetof(dev_image_t, _width);
constexpr size_t FieldsBytes = sizeof(dev_image_t) - FieldsBegin;
constexpr size_t DescriptionBytes = sizeof(uint32_t) + FieldsBytes;

} // namespace

void describeImages(cl_device_id Device) {
  // What the standard asks of a full profile, at least.
  Device->image_support = CL_TRUE;
  Device->image2d_max_width = Device->image2d_max_height = 16384;
  Device->image3d_max_width = Device->image3d_max_height = 2048;
  Device->image3d_max_depth = 2048;
  Device->image_max_buffer_size = 65536;
  Device->image_max_array_size = 2048;
  Device->max_samplers = 16;
  Device->max_read_image_args = 128;
  Device->max_write_image_args = 64;
  Device->max_read_write_image_args = 64;
  for (size_t I = 0; I < NUM_OPENCL_IMAGE_TYPES; ++I) {
    Device->image_formats[I] = Formats.data();
    Device->num_image_formats[I] = Formats.size() - Depths.size();
  }
  for (const cl_mem_object_type Type :
       {CL_MEM_OBJECT_IMAGE2D, CL_MEM_OBJECT_IMAGE2D_ARRAY})
    Device->num_image_formats[pocl_opencl_image_type_to_index(Type)] =
        Formats.size();
}

size_t rowPitch(const _cl_mem &Image) {
  return Image.type == CL_MEM_OBJECT_IMAGE1D_ARRAY ? Image.image_slice_pitch
                                                   : Image.image_row_pitch;
}

size_t beginInBuffer(const _cl_mem &Memory) {
  return Memory.buffer ? Memory.buffer->origin : 0;
}

uint32_t samplerValue(const pocl_argument &Argument) {
  dev_sampler_t Value = 0;
  pocl_fill_dev_sampler_t(&Value, const_cast<pocl_argument *>(&Argument));
  return static_cast<uint32_t>(Value);
}

ImageDescriptions::~ImageDescriptions() {
  for (const uint32_t Address : Addresses)
    vx_mem_free(Device, Address);
}

std::optional<uint32_t> ImageDescriptions::add(pocl_argument &Argument,
                                               cl_device_id OpenCl) {
  cl_mem Image;
  memcpy(&Image, Argument.value, sizeof(Image));
  dev_image_t Description{};
  pocl_fill_dev_image_t(&Description, &Argument, OpenCl);
  Description._row_pitch = static_cast<cl_int>(rowPitch(*Image));
  const size_t Begin = beginInBuffer(*Image);
  IMAGE1D_TO_BUFFER(Image);
  const auto Texels = static_cast<uint32_t>(
      Begin + reinterpret_cast<uintptr_t>(
                  Image->device_ptrs[OpenCl->global_mem_id].device_addr));

  std::array<std::byte, DescriptionBytes> Bytes{};
  memcpy(Bytes.data(), &Texels, sizeof(Texels));
  memcpy(&Bytes[sizeof(Texels)],
         reinterpret_cast<const std::byte *>(&Description) + FieldsBegin,
         FieldsBytes);
  uint32_t Address = 0;
  if (vx_mem_alloc(Device, Bytes.size(), &Address) != VX_OK)
    return std::nullopt;
  Addresses.push_back(Address);
  if (vx_copy_to_device(Device, Address, Bytes.data(), Bytes.size()) != VX_OK)
    return std::nullopt;
  return Address;
}

} // namespace vorion
