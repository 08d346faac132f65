#include "options.hpp"

#include <algorithm>

namespace csgrt::cli {

namespace {

constexpr std::size_t help_width = 100, help_column = 28;

/// The row "  left    right", the right side wrapped at words, and its lines indented to one column.
std::string help_row(const std::string& left, const std::string& right) {
    std::string out, line = "  " + left;
    if (line.size() + 2 > help_column) {
        out = line + "\n";
        line.clear();
    }
    line.resize(help_column, ' ');
    for (std::size_t begin = 0; begin < right.size();) {
        std::size_t end = std::min(right.find(' ', begin), right.size());
        if (line.size() + end - begin >= help_width) {
            out += line + "\n";
            line.assign(help_column, ' ');
        }
        line += (line.size() > help_column ? " " : "") + right.substr(begin, end - begin);
        begin = end + 1;
    }
    return out + line + "\n";
}

std::string head(const Option& option) {
    std::string text = option.letter ? std::string("-") + option.letter + ", " : std::string();
    return text + option.name + (option.value.empty() ? "" : " " + option.value);
}

}  // namespace

Option& Options::add(std::string name, std::string type, std::string help, std::string expected,
                     std::function<bool(const std::string&)> accept) {
    Option& option = options_.emplace_back();
    option.name = std::move(name);
    option.value = std::move(type);
    option.help = std::move(help);
    option.expected = std::move(expected);
    option.accept = std::move(accept);
    return option;
}

Option& Options::flag(std::string name, std::string help, bool& target, bool value) {
    return add(std::move(name), {}, std::move(help), {}, [&target, value](const std::string&) {
        target = value;
        return true;
    });
}

Option& Options::text(std::string name, std::string type, std::string help, std::string& target) {
    return add(std::move(name), std::move(type), std::move(help), "a name", [&target](const std::string& text) {
        target = text;
        return !text.empty();
    });
}

Option& Options::list(std::string name, std::string type, std::string help, std::vector<std::string>& target) {
    auto accept = [&target](const std::string& text) {
        target.push_back(text);
        return !text.empty();
    };
    Option& option = add(std::move(name), std::move(type), std::move(help), "a name", accept);
    option.repeatable = true;
    return option;
}

void Options::argument(std::string name, std::string help, std::string& target) {
    arguments_.push_back({std::move(name), std::move(help), &target});
}

void Options::arguments(std::string name, std::string help, std::vector<std::string>& target) {
    rest_name_ = std::move(name);
    rest_help_ = std::move(help);
    rest_ = &target;
}

void Options::found(const std::string& where, std::string message, std::string suggestion) {
    Diagnostic diagnostic;
    diagnostic.place.pointer = where;
    diagnostic.message = std::move(message);
    diagnostic.suggestion = std::move(suggestion);
    findings_.push_back(std::move(diagnostic));
}

Option* Options::find(const std::string& word) {
    auto match = std::find_if(options_.begin(), options_.end(), [&](const Option& option) {
        return word == option.name || (option.letter && word == std::string("-") + option.letter);
    });
    return match == options_.end() ? nullptr : &*match;
}

void Options::unknown(const std::string& name) {
    std::vector<std::string_view> names = {"--help"};
    for (const Option& option : options_) names.push_back(option.name);
    found(name, "no such option",
          suggestion("--" + name.substr(std::min(name.find_first_not_of('-'), name.size())), names));
}

/// Reads the option at words[position] and its value. Afterwards `position` is the last word that was used.
void Options::parse_option(const std::vector<std::string>& words, std::size_t& position) {
    std::string name = words[position];
    if (name == "--help" || name == "-h") {
        help_wanted_ = true;
        return;
    }
    std::optional<std::string> value;
    if (name.starts_with("--")) {
        if (auto equals = name.find('='); equals != name.npos) {
            value = name.substr(equals + 1);
            name.resize(equals);
        }
    } else if (name.size() > 2 && find(name.substr(0, 2))) {  // -oFILE
        value = name.substr(2);
        name.resize(2);
    }
    Option* option = find(name);
    if (!option) return unknown(name);
    if (option->given && !option->repeatable && !option->value.empty())
        return found(option->name, "given more than once");
    option->given = true;
    if (option->value.empty()) {
        if (value) return found(option->name, "takes no value");
    } else if (!value) {
        if (position + 1 == words.size() || find(words[position + 1]))
            return found(option->name, "a value is missing: " + option->value);
        value = words[++position];
    }
    if (!option->accept(value.value_or("")))
        found(option->name, "'" + *value + "' is not " + option->expected, suggestion(*value, option->words));
}

void Options::parse_arguments(const std::vector<std::string>& words) {
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (i >= arguments_.size() && !rest_)
            found({}, "'" + words[i] + "' is one argument too many");
        else if (words[i].empty())
            found(i < arguments_.size() ? arguments_[i].name : rest_name_, "'' is not a name");
        else if (i < arguments_.size())
            *arguments_[i].target = words[i];
        else
            rest_->push_back(words[i]);
    }
    for (std::size_t i = words.size(); i < arguments_.size(); ++i)
        found(arguments_[i].name, "missing: " + arguments_[i].help);
}

void Options::check_presence() {
    for (const Option& option : options_) {
        if (option.required && !option.given) found(option.name, "missing: " + option.help);
        if (!option.given) continue;
        if (!option.excludes.empty() && find(option.excludes)->given)
            found(option.name, "cannot be combined with " + option.excludes);
    }
}

std::vector<Diagnostic> Options::parse(const std::vector<std::string>& words) {
    std::vector<std::string> plain;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (words[i] == "--") {
            plain.insert(plain.end(), words.begin() + i + 1, words.end());
            break;
        }
        if (words[i].size() > 1 && words[i][0] == '-')
            parse_option(words, i);
        else
            plain.push_back(words[i]);
    }
    parse_arguments(plain);
    check_presence();
    return findings_;
}

std::string Options::help() const {
    std::string text;
    for (const Argument& argument : arguments_) text += help_row(argument.name, argument.help);
    if (rest_) text += help_row(rest_name_ + "...", rest_help_);
    if (!text.empty()) text += "\n";
    for (const Option& option : options_) text += help_row(head(option), option.help);
    return text + help_row("-h, --help", "print this");
}

}  // namespace csgrt::cli
