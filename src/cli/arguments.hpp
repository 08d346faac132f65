// Parses the command line and prints its help.
#pragma once

#include <string>
#include <vector>

#include "cli/commands/commands.hpp"

namespace csgrt::cli {

/// `words` are the arguments after the program's name. Throws Error (usage) with every finding: unknown options with
/// the nearest known one, values out of range, missing and surplus arguments.
Command parse_arguments(const std::vector<std::string>& words);

/// The text that `csgrt help COMMAND` prints; "" for csgrt itself. Throws Error (usage) if there is no such command.
std::string help_text(const std::string& command);

}  // namespace csgrt::cli
