/// Checks of the host: disk space, memory, vector extensions.
#pragma once

#include "doctor/Diagnosis.h"
#include "vorion/support/KernelCacheFolder.h"

#include <cstdint>
#include <string>

namespace vorion::splat {

/// The free space on the disk of \p Folder.
Diagnosis examineDisk(const std::string &Folder, uint64_t FreeBytes);
/// The same, with the current free space.
Diagnosis examineDisk(const std::string &Folder);

/// The available main memory.
Diagnosis examineMemory(uint64_t AvailableBytes);
/// The same, with the value in /proc/meminfo.
Diagnosis examineMemory();

/// The widest vector extension that the simulator uses on this processor.
Diagnosis examineVectors();

/// The cache of compiled kernels, and the folders that were rejected for it.
Diagnoses examineCache(const KernelCacheFolder &Cache);
/// The system-wide cache \p Folder, filled by root, if it exists.
Diagnosis examineSystemCache(const std::string &Folder);

} // namespace vorion::splat
