// Shell words: quote texts in commands that a user can copy.
#pragma once

#include <string>
#include <string_view>

namespace csgrt {

/// The text as one word of a shell's command, in quotes where needed.
inline std::string shell_word(const std::string& text) {
    constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_@%+=:,./-";
    if (!text.empty() && text.find_first_not_of(plain) == text.npos) return text;
    std::string word = "'";
    for (const char c : text) c == '\'' ? word += "'\\''" : word += c;
    return word + "'";
}

}  // namespace csgrt
