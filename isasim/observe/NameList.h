/// Options whose text lists names, such as `--check bounds,race`.
#pragma once

#include "vorion/support/Expected.h"

#include <cstdint>
#include <span>
#include <string_view>

namespace vorion::isasim {

/// A bit for each of \p Names, in their order, that \p Text lists, apart by
/// commas. "all" stands for every name. An error calls a name a \p Kind, and
/// ends with \p Note.
Expected<uint32_t> parseNameList(std::string_view Kind, std::string_view Text,
                                 std::span<const std::string_view> Names,
                                 std::string_view Note = "");

} // namespace vorion::isasim
