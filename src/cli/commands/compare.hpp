// Comparison of two files of one kind. Both functions print a report and return Status::ok or Status::differs.
#pragma once

#include "commands.hpp"

namespace csgrt::cli {

Status compare_images(const CompareArguments& arguments);
Status compare_partitions(const CompareArguments& arguments);

/// "1 ray", "2 rays".
std::string counted(std::uint64_t count, const char* noun);

}  // namespace csgrt::cli
