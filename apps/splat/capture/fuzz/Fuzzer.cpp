/// A libFuzzer program; VORION_FUZZ_TARGET is one of Targets.h.

#include "capture/fuzz/Targets.h"

#include <cstdint>
#include <span>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *Data, size_t Size);

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *Data, size_t Size) {
  vorion::splat::fuzz::VORION_FUZZ_TARGET(std::as_bytes(std::span(Data, Size)));
  return 0;
}
