/// Which pages of a mapping have ever been touched.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace vorion::isasim {

/// For each page of \p PageBytes of \p Memory, which begins with a page of the
/// host: whether the host has given it memory, or may have. All others of an
/// anonymous Mapping are zero, and looking at them would cost memory and time:
/// a machine has gigabytes that no program uses. Where the host does not tell
/// (proc_pid_pagemap(5)), every page counts as touched.
std::vector<bool> touchedPages(std::span<const std::byte> Memory,
                               size_t PageBytes);

} // namespace vorion::isasim
