#include "MemoryOperations.h"
#include "Description.h"
#include "Device.h"
#include "Images.h"

extern "C" {
#include "common_driver.h"
#include "pocl_util.h"
}

#include <array>
#include <cstring>

namespace vorion {

namespace {

cl_int allocate(cl_device_id Device, cl_mem Buffer, void *) {
  VorionDevice &Own = deviceOf(Device);
  // The host's copy of such a buffer cannot be the device's.
  if ((Buffer->flags & CL_MEM_ALLOC_HOST_PTR) && !Buffer->mem_host_ptr)
    return CL_MEM_OBJECT_ALLOCATION_FAILURE;
  vx_device_info Now{};
  if (vx_device_get_info(Own.Opened.get(), &Now) != VX_OK ||
      Now.free_bytes < Buffer->size + keptForLaunches(Now))
    return CL_MEM_OBJECT_ALLOCATION_FAILURE;
  uint32_t Address = 0;
  void *Host = nullptr;
  if (vx_mem_alloc(Own.Opened.get(), Buffer->size, &Address) != VX_OK)
    return CL_MEM_OBJECT_ALLOCATION_FAILURE;
  if (vx_mem_host_pointer(Own.Opened.get(), Address, Buffer->size, &Host) !=
      VX_OK) {
    vx_mem_free(Own.Opened.get(), Address);
    return CL_MEM_OBJECT_ALLOCATION_FAILURE;
  }
  pocl_mem_identifier &Id = Buffer->device_ptrs[Device->global_mem_id];
  Id.mem_ptr = Host;
  Id.device_addr = reinterpret_cast<void *>(static_cast<uintptr_t>(Address));
  Id.version = 0;
  if (Buffer->has_device_address)
    Id.is_pinned = 1;
  return CL_SUCCESS;
}

void release(cl_device_id Device, cl_mem Buffer) {
  pocl_mem_identifier &Id = Buffer->device_ptrs[Device->global_mem_id];
  vx_mem_free(
      deviceOf(Device).Opened.get(),
      static_cast<uint32_t>(reinterpret_cast<uintptr_t>(Id.device_addr)));
  Id.mem_ptr = nullptr;
  Id.device_addr = nullptr;
  Id.version = 0;
}

// PoCL's copying code uses the host's view of the memory: what it did is said
// afterwards, of rectangles the whole buffer.

using Notice = vx_status (*)(vx_device *, uint32_t, uint64_t);

uint32_t addressOf(const pocl_mem_identifier *Id, size_t Offset) {
  return static_cast<uint32_t>(reinterpret_cast<uintptr_t>(Id->device_addr) +
                               Offset);
}

void tell(Notice What, void *Data, const pocl_mem_identifier *Id, size_t Offset,
          size_t Size) {
  What(static_cast<VorionDevice *>(Data)->Opened.get(), addressOf(Id, Offset),
       Size);
}

void tellWritten(void *Data, const pocl_mem_identifier *Id, size_t Offset,
                 size_t Size) {
  tell(vx_mem_written, Data, Id, Offset, Size);
}

void tellRead(void *Data, const pocl_mem_identifier *Id, size_t Offset,
              size_t Size) {
  tell(vx_mem_read, Data, Id, Offset, Size);
}

void timeCopy(void *Data, vx_copy_kind Kind, const pocl_mem_identifier *Id,
              size_t Offset, size_t Size, uint32_t From = 0) {
  vx_command_copy(static_cast<VorionDevice *>(Data)->Opened.get(), Kind,
                  addressOf(Id, Offset), From, Size);
}

// The clock times the copy of a rectangle as one of as many bytes in a row.
size_t bytesOf(const size_t *Region) {
  return Region[0] * Region[1] * Region[2];
}

size_t beginOf(const size_t *Origin, size_t RowPitch, size_t SlicePitch) {
  return Origin[0] + Origin[1] * RowPitch + Origin[2] * SlicePitch;
}

void read(void *Data, void *To, pocl_mem_identifier *From, cl_mem Buffer,
          size_t Offset, size_t Size) {
  pocl_driver_read(Data, To, From, Buffer, Offset, Size);
  tellRead(Data, From, Offset, Size);
  timeCopy(Data, VX_COPY_FROM_DEVICE, From, Offset, Size);
}

void readRect(void *Data, void *To, pocl_mem_identifier *From, cl_mem Buffer,
              const size_t *BufferOrigin, const size_t *HostOrigin,
              const size_t *Region, size_t BufferRowPitch,
              size_t BufferSlicePitch, size_t HostRowPitch,
              size_t HostSlicePitch) {
  pocl_driver_read_rect(Data, To, From, Buffer, BufferOrigin, HostOrigin,
                        Region, BufferRowPitch, BufferSlicePitch, HostRowPitch,
                        HostSlicePitch);
  tellRead(Data, From, beginInBuffer(*Buffer), Buffer->size);
  timeCopy(Data, VX_COPY_FROM_DEVICE, From,
           beginOf(BufferOrigin, BufferRowPitch, BufferSlicePitch),
           bytesOf(Region));
}

void write(void *Data, const void *From, pocl_mem_identifier *To, cl_mem Buffer,
           size_t Offset, size_t Size) {
  pocl_driver_write(Data, From, To, Buffer, Offset, Size);
  tellWritten(Data, To, Offset, Size);
  timeCopy(Data, VX_COPY_TO_DEVICE, To, Offset, Size);
}

void writeRect(void *Data, const void *From, pocl_mem_identifier *To,
               cl_mem Buffer, const size_t *BufferOrigin,
               const size_t *HostOrigin, const size_t *Region,
               size_t BufferRowPitch, size_t BufferSlicePitch,
               size_t HostRowPitch, size_t HostSlicePitch) {
  pocl_driver_write_rect(Data, From, To, Buffer, BufferOrigin, HostOrigin,
                         Region, BufferRowPitch, BufferSlicePitch, HostRowPitch,
                         HostSlicePitch);
  tellWritten(Data, To, beginInBuffer(*Buffer), Buffer->size);
  timeCopy(Data, VX_COPY_TO_DEVICE, To,
           beginOf(BufferOrigin, BufferRowPitch, BufferSlicePitch),
           bytesOf(Region));
}

void copy(void *Data, pocl_mem_identifier *To, cl_mem ToBuffer,
          pocl_mem_identifier *From, cl_mem FromBuffer, size_t ToOffset,
          size_t FromOffset, size_t Size) {
  pocl_driver_copy(Data, To, ToBuffer, From, FromBuffer, ToOffset, FromOffset,
                   Size);
  tellRead(Data, From, FromOffset, Size);
  tellWritten(Data, To, ToOffset, Size);
  timeCopy(Data, VX_COPY_ON_DEVICE, To, ToOffset, Size,
           addressOf(From, FromOffset));
}

void copyWithSize(void *Data, pocl_mem_identifier *To, cl_mem ToBuffer,
                  pocl_mem_identifier *From, cl_mem FromBuffer,
                  pocl_mem_identifier *SizeId, cl_mem SizeBuffer,
                  size_t ToOffset, size_t FromOffset, size_t Size) {
  pocl_driver_copy_with_size(Data, To, ToBuffer, From, FromBuffer, SizeId,
                             SizeBuffer, ToOffset, FromOffset, Size);
  tellRead(Data, From, FromOffset, Size);
  tellWritten(Data, To, ToOffset, Size);
  timeCopy(Data, VX_COPY_ON_DEVICE, To, ToOffset, Size,
           addressOf(From, FromOffset));
}

void copyRect(void *Data, pocl_mem_identifier *To, cl_mem ToBuffer,
              pocl_mem_identifier *From, cl_mem FromBuffer,
              const size_t *ToOrigin, const size_t *FromOrigin,
              const size_t *Region, size_t ToRowPitch, size_t ToSlicePitch,
              size_t FromRowPitch, size_t FromSlicePitch) {
  pocl_driver_copy_rect(Data, To, ToBuffer, From, FromBuffer, ToOrigin,
                        FromOrigin, Region, ToRowPitch, ToSlicePitch,
                        FromRowPitch, FromSlicePitch);
  tellRead(Data, From, beginInBuffer(*FromBuffer), FromBuffer->size);
  tellWritten(Data, To, beginInBuffer(*ToBuffer), ToBuffer->size);
  timeCopy(Data, VX_COPY_ON_DEVICE, To,
           beginOf(ToOrigin, ToRowPitch, ToSlicePitch), bytesOf(Region),
           addressOf(From, beginOf(FromOrigin, FromRowPitch, FromSlicePitch)));
}

void fill(void *Data, pocl_mem_identifier *To, cl_mem Buffer, size_t Size,
          size_t Offset, const void *Pattern, size_t PatternSize) {
  pocl_driver_memfill(Data, To, Buffer, Size, Offset, Pattern, PatternSize);
  tellWritten(Data, To, Offset, Size);
  timeCopy(Data, VX_COPY_FILL, To, Offset, Size);
}

/// The machine's memory is the host's, too. Only what the program wants to have
/// in memory of its own is copied there.
cl_int mappingPointer(void *, pocl_mem_identifier *Id, cl_mem Buffer,
                      mem_mapping_t *Map) {
  void *Base =
      Buffer->flags & CL_MEM_USE_HOST_PTR ? Buffer->mem_host_ptr : Id->mem_ptr;
  Map->host_ptr = static_cast<char *>(Base) + Map->offset;
  return CL_SUCCESS;
}

cl_int freeMappingPointer(void *, pocl_mem_identifier *, cl_mem,
                          mem_mapping_t *Map) {
  Map->host_ptr = nullptr;
  return CL_SUCCESS;
}

cl_int map(void *Data, pocl_mem_identifier *From, cl_mem Buffer,
           mem_mapping_t *Map) {
  const cl_int Status = pocl_driver_map_mem(Data, From, Buffer, Map);
  if (Map->map_flags & CL_MAP_READ) {
    tellRead(Data, From, Map->offset, Map->size);
    timeCopy(Data, VX_COPY_FROM_DEVICE, From, Map->offset, Map->size);
  }
  return Status;
}

cl_int unmap(void *Data, pocl_mem_identifier *To, cl_mem Buffer,
             mem_mapping_t *Map) {
  const cl_int Status = pocl_driver_unmap_mem(Data, To, Buffer, Map);
  if (!(Map->map_flags & CL_MAP_READ) || (Map->map_flags & CL_MAP_WRITE)) {
    tellWritten(Data, To, Map->offset, Map->size);
    timeCopy(Data, VX_COPY_TO_DEVICE, To, Map->offset, Map->size);
  }
  return Status;
}

// Images lie in memory as buffers do: a region of one is a rectangle of bytes.

/// A region of texels, in bytes.
std::array<size_t, 3> inBytes(const _cl_mem &Image, const size_t *Texels) {
  return {Texels[0] * Image.image_elem_size * Image.image_channels, Texels[1],
          Texels[2]};
}

/// An origin in an image as one in the memory that it is made of, in bytes.
std::array<size_t, 3> originInBytes(const _cl_mem &Image,
                                    const size_t *Texels) {
  std::array<size_t, 3> Origin = inBytes(Image, Texels);
  Origin[0] += beginInBuffer(Image);
  return Origin;
}

constexpr size_t Beginning[3] = {0, 0, 0};

/// How a region of an image lies outside of images: rows and slices one after
/// the other, in memory of the program's with the pitches that it gives.
struct Outside {
  Outside(const _cl_mem &Image, const size_t *Region, bool Programs,
          size_t GivenRowPitch, size_t GivenSlicePitch)
      : RowPitch(Programs ? GivenRowPitch : 0),
        SlicePitch(Programs ? GivenSlicePitch : 0) {
    if (Image.type == CL_MEM_OBJECT_IMAGE1D_ARRAY && SlicePitch)
      RowPitch = SlicePitch;
    if (!RowPitch)
      RowPitch = inBytes(Image, Region)[0];
    if (!SlicePitch)
      SlicePitch = RowPitch * Region[1];
  }
  size_t RowPitch, SlicePitch;
};

cl_int readImage(void *Data, cl_mem Image, pocl_mem_identifier *From,
                 void *ToHost, pocl_mem_identifier *ToBuffer,
                 const size_t *Origin, const size_t *Region, size_t RowPitch,
                 size_t SlicePitch, size_t Offset) {
  const Outside To(*Image, Region, ToHost, RowPitch, SlicePitch);
  void *Start = ToHost ? ToHost : ToBuffer->mem_ptr;
  readRect(Data, static_cast<char *>(Start) + Offset, From, Image,
           originInBytes(*Image, Origin).data(), Beginning,
           inBytes(*Image, Region).data(), rowPitch(*Image),
           Image->image_slice_pitch, To.RowPitch, To.SlicePitch);
  if (ToBuffer)
    tellWritten(Data, ToBuffer, Offset, To.SlicePitch * Region[2]);
  return CL_SUCCESS;
}

cl_int writeImage(void *Data, cl_mem Image, pocl_mem_identifier *To,
                  const void *FromHost, pocl_mem_identifier *FromBuffer,
                  const size_t *Origin, const size_t *Region, size_t RowPitch,
                  size_t SlicePitch, size_t Offset) {
  const Outside From(*Image, Region, FromHost, RowPitch, SlicePitch);
  const void *Start = FromHost ? FromHost : FromBuffer->mem_ptr;
  writeRect(Data, static_cast<const char *>(Start) + Offset, To, Image,
            originInBytes(*Image, Origin).data(), Beginning,
            inBytes(*Image, Region).data(), rowPitch(*Image),
            Image->image_slice_pitch, From.RowPitch, From.SlicePitch);
  if (FromBuffer)
    tellRead(Data, FromBuffer, Offset, From.SlicePitch * Region[2]);
  return CL_SUCCESS;
}

cl_int copyImage(void *Data, cl_mem From, cl_mem To,
                 pocl_mem_identifier *FromId, pocl_mem_identifier *ToId,
                 const size_t *FromOrigin, const size_t *ToOrigin,
                 const size_t *Region) {
  copyRect(Data, ToId, To, FromId, From, originInBytes(*To, ToOrigin).data(),
           originInBytes(*From, FromOrigin).data(),
           inBytes(*From, Region).data(), rowPitch(*To), To->image_slice_pitch,
           rowPitch(*From), From->image_slice_pitch);
  return CL_SUCCESS;
}

cl_int fillImage(void *Data, cl_mem Image, pocl_mem_identifier *Id,
                 const size_t *Origin, const size_t *Region, cl_uint4,
                 pixel_t Texel, size_t TexelBytes) {
  char *Start = static_cast<char *>(Id->mem_ptr) + Origin[0] * TexelBytes +
                Origin[1] * rowPitch(*Image) +
                Origin[2] * Image->image_slice_pitch;
  for (size_t Z = 0; Z < Region[2]; ++Z)
    for (size_t Y = 0; Y < Region[1]; ++Y)
      for (size_t X = 0; X < Region[0]; ++X)
        memcpy(Start + Z * Image->image_slice_pitch + Y * rowPitch(*Image) +
                   X * TexelBytes,
               Texel, TexelBytes);
  tellWritten(Data, Id, 0, Image->size);
  timeCopy(Data, VX_COPY_FILL, Id,
           beginOf(originInBytes(*Image, Origin).data(), rowPitch(*Image),
                   Image->image_slice_pitch),
           bytesOf(inBytes(*Image, Region).data()));
  return CL_SUCCESS;
}

/// Whether a mapped region is the program's memory rather than the machine's.
bool isApart(const mem_mapping_t &Map, const pocl_mem_identifier &Id) {
  return Map.host_ptr != static_cast<char *>(Id.mem_ptr) + Map.offset;
}

cl_int mapImage(void *Data, pocl_mem_identifier *From, cl_mem Image,
                mem_mapping_t *Map) {
  if (Map->map_flags & CL_MAP_WRITE_INVALIDATE_REGION)
    return CL_SUCCESS;
  if (isApart(*Map, *From))
    return readImage(Data, Image, From, Map->host_ptr, nullptr, Map->origin,
                     Map->region, Map->row_pitch, Map->slice_pitch, 0);
  tellRead(Data, From, 0, Image->size);
  timeCopy(Data, VX_COPY_FROM_DEVICE, From, 0, Image->size);
  return CL_SUCCESS;
}

cl_int unmapImage(void *Data, pocl_mem_identifier *To, cl_mem Image,
                  mem_mapping_t *Map) {
  if (Map->map_flags == CL_MAP_READ)
    return CL_SUCCESS;
  if (isApart(*Map, *To))
    return writeImage(Data, Image, To, Map->host_ptr, nullptr, Map->origin,
                      Map->region, Map->row_pitch, Map->slice_pitch, 0);
  tellWritten(Data, To, 0, Image->size);
  timeCopy(Data, VX_COPY_TO_DEVICE, To, 0, Image->size);
  return CL_SUCCESS;
}

} // namespace

void setMemoryOperations(pocl_device_ops *Ops) {
  Ops->alloc_mem_obj = allocate;
  Ops->free = release;
  Ops->read = read;
  Ops->read_rect = readRect;
  Ops->write = write;
  Ops->write_rect = writeRect;
  Ops->copy = copy;
  Ops->copy_with_size = copyWithSize;
  Ops->copy_rect = copyRect;
  Ops->memfill = fill;
  Ops->map_mem = map;
  Ops->unmap_mem = unmap;
  Ops->get_mapping_ptr = mappingPointer;
  Ops->free_mapping_ptr = freeMappingPointer;

  Ops->read_image_rect = readImage;
  Ops->write_image_rect = writeImage;
  Ops->copy_image_rect = copyImage;
  Ops->fill_image = fillImage;
  Ops->map_image = mapImage;
  Ops->unmap_image = unmapImage;
}

} // namespace vorion
