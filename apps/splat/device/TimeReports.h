/// Time reports of kernels (CL_EVENT_TIME_REPORT_VORION, docs/model.md).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace vorion::splat {

/// Makes \p Sum the report of what it is about and then of what \p Report is
/// about: counts and cycles are added, what names the machine stays. Null is no
/// report.
void addTimeReport(nlohmann::ordered_json &Sum,
                   const nlohmann::ordered_json &Report);

/// The same of texts, as the device gives them; empty ones are no report.
std::string addTimeReports(const std::string &A, const std::string &B);

} // namespace vorion::splat
