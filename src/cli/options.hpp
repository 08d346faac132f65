// Options and arguments of a command: sets variables from a command line, and prints the help.
#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <csgrt/error.hpp>

#include "values.hpp"

namespace csgrt::cli {

/// One option. The name begins with two dashes; `letter` is its short form or 0.
struct Option {
    std::string name;
    char letter = 0;
    std::string value;  ///< name of its value in the help; empty for a flag
    std::string help;
    std::string expected;                            ///< "'x' is not ..."
    std::vector<std::string_view> words;             ///< values that are names; the nearest is suggested
    std::function<bool(const std::string&)> accept;  ///< sets the target; false: the value is refused
    bool repeatable = false, required = false, given = false;
    std::string excludes;  ///< name of an option that must not be given, too
};

/// The options of one command. Targets must outlive the object.
class Options {
public:
    Option& flag(std::string name, std::string help, bool& target, bool value = true);

    /// `read` turns text into an optional that is empty for a wrong value.
    template <class Target, class Parse>
    Option& value(std::string name, std::string type, std::string help, Target& target, Parse read,
                  std::string expected) {
        return add(std::move(name), std::move(type), std::move(help), std::move(expected),
                   [&target, read](const std::string& text) {
                       auto result = read(text);
                       if (result) target = *std::move(result);
                       return result.has_value();
                   });
    }

    /// An option that may be given several times; `read` turns each text into an optional, whose value is appended.
    template <class Target, class Parse>
    Option& each(std::string name, std::string type, std::string help, std::vector<Target>& target, Parse read,
                 std::string expected) {
        Option& option = add(std::move(name), std::move(type), std::move(help), std::move(expected),
                             [&target, read](const std::string& text) {
                                 auto result = read(text);
                                 if (result) target.push_back(*std::move(result));
                                 return result.has_value();
                             });
        option.repeatable = true;
        return option;
    }

    /// An option with a number from `low` up to, but without, `high`.
    template <class Target>
    Option& number(std::string name, std::string type, std::string help, Target& target, double low, double high,
                   std::string expected) {
        auto read = [low, high](const std::string& text) {
            auto number = parse_number(text);
            return number && *number >= low && *number < high ? number : std::nullopt;
        };
        return value(std::move(name), std::move(type), std::move(help), target, read, std::move(expected));
    }

    /// An option with a whole number from `low` to `high`.
    template <class Target>
    Option& count(std::string name, std::string help, Target& target, std::uint64_t low, std::uint64_t high) {
        auto read = [low, high](const std::string& text) {
            auto number = parse_count(text);
            bool fits = number && *number >= low && *number <= high;
            return fits ? std::optional(static_cast<Target>(*number)) : std::nullopt;
        };
        return value(std::move(name), "N", std::move(help), target, read,
                     "a whole number from " + std::to_string(low) + " to " + std::to_string(high));
    }

    /// An option with one of the names of a table, pairs of name and value.
    template <class Target, class Names>
    Option& choice(std::string name, std::string help, Target& target, const Names& names) {
        std::string type;
        for (const auto& entry : names) type.append(type.empty() ? "" : "|").append(entry.first);
        auto read = [&names](const std::string& text) { return find_name(names, text); };
        Option& option = value(std::move(name), type, std::move(help), target, read, "one of " + type);
        for (const auto& entry : names) option.words.push_back(entry.first);
        return option;
    }

    Option& text(std::string name, std::string type, std::string help, std::string& target);

    /// An option that may be given several times; each value is appended.
    Option& list(std::string name, std::string type, std::string help, std::vector<std::string>& target);

    /// A required argument. Arguments have the order of these calls.
    void argument(std::string name, std::string help, std::string& target);
    /// All arguments after the required ones.
    void arguments(std::string name, std::string help, std::vector<std::string>& target);

    /// Returns every finding; empty means that all targets are set. Words after "--" are arguments, also if they begin
    /// with "-".
    std::vector<Diagnostic> parse(const std::vector<std::string>& words);

    bool help_wanted() const { return help_wanted_; }
    std::string help() const;

private:
    struct Argument {
        std::string name, help;
        std::string* target;
    };

    Option& add(std::string name, std::string type, std::string help, std::string expected,
                std::function<bool(const std::string&)> accept);
    Option* find(const std::string& word);
    void unknown(const std::string& name);
    void parse_option(const std::vector<std::string>& words, std::size_t& position);
    void parse_arguments(const std::vector<std::string>& words);
    void check_presence();
    void found(const std::string& where, std::string message, std::string suggestion = {});

    std::list<Option> options_;  ///< a list: references to its elements stay valid
    std::vector<Argument> arguments_;
    std::string rest_name_, rest_help_;
    std::vector<std::string>* rest_ = nullptr;
    std::vector<Diagnostic> findings_;
    bool help_wanted_ = false;
};

}  // namespace csgrt::cli
