/// What the host must have: room, memory, vectors.
#pragma once

#include "doctor/Diagnosis.h"
#include "vorion/support/KernelCacheFolder.h"

#include <cstdint>
#include <string>

namespace vorion::splat {

/// \p Folder and the bytes that are free on its disk.
Diagnosis examineDisk(const std::string &Folder, uint64_t FreeBytes);
/// The same for the disk that \p Folder is on now.
Diagnosis examineDisk(const std::string &Folder);

/// The bytes of main memory that programs can still get.
Diagnosis examineMemory(uint64_t AvailableBytes);
/// The same for this host now, as the text of /proc/meminfo has it.
Diagnosis examineMemory();

/// The widest vectors of this processor that the simulator uses.
Diagnosis examineVectors();

/// The cache of compiled kernels, and the folders that were passed over for it.
Diagnoses examineCache(const KernelCacheFolder &Cache);
/// \p Folder, which root has filled for all users, if it is there.
Diagnosis examineSystemCache(const std::string &Folder);

} // namespace vorion::splat
