/// Kernel arguments as vorion-sim's command line and JSON write them.
#pragma once

#include "vorion/support/Expected.h"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::isasim {

/// One argument.
///
///   i32:5 u32:7 i64:9 u64:1 f32:1.5    a value
///   bytes:00ff12                       a value, byte by byte
///   buf:4096                           a zeroed buffer of that many bytes
///   buf@in.bin                         a buffer with the file's contents
///   out:4096@out.bin                   a zeroed buffer, written to the file
///   inout:data.bin                     read from and written to one file
///   inout:in.bin@out.bin               read from one, written to another
///   local:256                          that many bytes of local memory
struct KernelInput {
  /// In the order of VX_ARG_*; a Value is bytes of any type.
  enum Kind { Value, Buffer, Local, Integer, Float } What = Value;
  std::vector<std::byte> Bytes;  ///< of what is passed by value
  uint64_t Size = 0;             ///< of a buffer without ReadFrom, or local
  std::string ReadFrom, WriteTo; ///< files, empty for none
};

Expected<KernelInput> parseInput(std::string_view Text);

/// A launch: what --kernel, --global, --local and --arg say.
struct KernelRequest {
  std::string Kernel; ///< empty: the program's only kernel
  std::array<uint32_t, 3> Global{};
  std::array<uint32_t, 3> Local{}; ///< 0: chosen
  unsigned WorkDim = 0;            ///< 0: no launch
  std::vector<std::string> Args;
};

/// "X[,Y[,Z]]" into Sizes (1 where left out); the number of dimensions, 0 if
/// it is not that.
unsigned parseSizes(std::string_view Text, std::array<uint32_t, 3> &Sizes);

/// {"kernel": "name", "global": [64, 64], "local": [8, 8], "args": ["i32:5"]}
/// with "kernel" and "local" optional.
Expected<KernelRequest> parseRequest(std::string_view Json,
                                     const std::string &Where);

} // namespace vorion::isasim
