/// Whether OpenCL programs find the device, and whether it works.
#pragma once

#include "device/DeviceOptions.h"
#include "doctor/Diagnosis.h"

#include <string>
#include <vector>

namespace vorion::splat {

/// The libraries of OpenCL platforms that the loader is told of in \p Vendors,
/// a folder of files *.icd, one such file, or a library itself.
struct Vendors {
  Diagnosis Found;
  std::vector<std::string> Libraries;
};
Vendors examineVendors(const std::string &Place);
/// Where the loader looks: OCL_ICD_VENDORS, or the system's folder.
std::string vendorsPlace();

/// Whether the compiler is where the platform looks for it: below \p Root,
/// or, if that is empty, in the folders above one of \p Libraries.
Diagnosis examineTools(const std::string &Root,
                       const std::vector<std::string> &Libraries);

/// Faults of \p Libraries that end a program which looks for their devices,
/// each tried in a process of its own.
Diagnoses examineLibraries(const std::vector<std::string> &Libraries);

/// Opens the device and runs a kernel on it.
Diagnoses examineDevice(const DeviceOptions &Options);

} // namespace vorion::splat
