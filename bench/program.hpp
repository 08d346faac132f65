// What the programs of bench/ begin with: their options, the folder of the kernel cache, errors.
#pragma once

#include <charconv>
#include <cstdio>
#include <functional>
#include <map>
#include <string>
#include <system_error>
#include <type_traits>
#include <vector>

#include <csgrt/error.hpp>

namespace csgrt::bench {

/// Throws Error (usage), which names the option, if the text is no such number.
template <class Number>
Number parse_number(const std::string& option, const std::string& text, Number least, Number most) {
    Number value{};
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (fault != std::errc() || end != text.data() + text.size() || !(value >= least && value <= most)) {
        char range[80];
        std::snprintf(range, sizeof range, "%g to %g", static_cast<double>(least), static_cast<double>(most));
        throw Error(Status::usage, option + ": needs a " + (std::is_integral_v<Number> ? "whole number" : "number") +
                                       " from " + range + ", not \"" + text + "\"");
    }
    return value;
}

/// The parts between commas.
std::vector<std::string> split_list(const std::string& list);

/// The options of a program: of each its name, and where its value goes. What they are bound to must outlive read().
class OptionReader {
public:
    using Take = std::function<void(const std::string& value)>;
    void value(const std::string& name, Take take) { options_[name] = {true, std::move(take)}; }
    void text(const std::string& name, std::string& to);
    /// The parts between commas.
    void list(const std::string& name, std::vector<std::string>& to);
    template <class Number>
    void number(const std::string& name, Number& to, std::type_identity_t<Number> least,
                std::type_identity_t<Number> most) {
        value(name, [=, &to](const std::string& text) { to = parse_number(name, text, least, most); });
    }
    /// An option without a value.
    void flag(const std::string& name, bool& to);

    /// Takes the words from number `first` on. Returns those that are no options, `most` of them at most. Throws Error
    /// (usage), which names the word: unknown, lacks its value, no such number.
    std::vector<std::string> read(int argc, char** argv, int first = 1, std::size_t most = 0) const;

private:
    struct Option {
        bool has_value = false;
        Take take;
    };
    std::map<std::string, Option> options_;
};

/// The work of a program's main(), with a folder for PoCL's kernel cache. Returns its exit status; of an Error, which
/// goes to standard error, that one's.
int run_program(const char* name, const std::function<int()>& work);

}  // namespace csgrt::bench
