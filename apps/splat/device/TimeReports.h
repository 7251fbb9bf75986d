/// Time reports of kernels (CL_EVENT_TIME_REPORT_VORION, docs/model.md).
#pragma once

#include <string>

namespace vorion::splat {

/// The report of two runs one after the other: counts and cycles are added,
/// what names the machine stays. Empty texts are no report.
std::string addTimeReports(const std::string &A, const std::string &B);

} // namespace vorion::splat
