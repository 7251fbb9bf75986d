/// Checks whether OpenCL programs find the device, and whether it works.
#pragma once

#include "device/DeviceOptions.h"
#include "doctor/Diagnosis.h"

#include <string>
#include <vector>

namespace vorion::splat {

/// The OpenCL platform libraries that the ICD loader finds: listed in a folder
/// of *.icd files, in one such file, or named directly.
struct Vendors {
  Diagnosis Found;
  std::vector<std::string> Libraries;
};
Vendors examineVendors(const std::string &Place);
/// The search path of the loader: OCL_ICD_VENDORS, or the system's folder.
std::string vendorsPlace();

/// Checks whether the platform finds the compiler: below \p Root or, if that is
/// empty, relative to one of \p Libraries.
Diagnosis examineTools(const std::string &Root,
                       const std::vector<std::string> &Libraries);

/// Faults of \p Libraries that terminate a program which queries their devices.
/// Each is checked in a separate process.
Diagnoses examineLibraries(const std::vector<std::string> &Libraries);

/// Opens the device and runs a kernel on it.
Diagnoses examineDevice(const DeviceOptions &Options);

} // namespace vorion::splat
