// Options of commands, made from the descriptions of public structs (form/requests.hpp).
#pragma once

#include <array>
#include <cctype>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "cli/options.hpp"
#include "cli/values.hpp"
#include "form/requests.hpp"

namespace csgrt::cli {

/// Makes the help's text from a description's sentence: removes the full stop and the capital letter, and adds the
/// default. For a flag that switches something off, the text is the sentence's part after "; else".
inline std::string help_of(std::string sentence, const form::Option& option) {
    constexpr std::string_view otherwise = "; else ";
    if (const std::size_t at = sentence.find(otherwise); option.is_off && at != sentence.npos)
        sentence.erase(0, at + otherwise.size());
    if (sentence.ends_with('.')) sentence.pop_back();
    const bool is_word = sentence.size() > 1 && std::isupper(static_cast<unsigned char>(sentence[1])) == 0;
    if (is_word) sentence[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(sentence[0])));
    if (*option.absent) sentence += std::string("; ") + option.absent + " if not given";
    return sentence;
}

inline bool allows(form::Any, double) { return true; }
inline bool allows(const form::Bounds& bounds, double number) { return bounds.hold(number); }

template <class Member, class Target>
Option& define_member(Options& options, const Member& member, Target& target) {
    const form::Option& o = member.option;
    using Kind = std::remove_cvref_t<decltype(member.kind)>;
    const std::string help = help_of(member.help, o);
    if constexpr (std::is_same_v<Target, bool>) {
        return options.flag(o.name, help, target, !o.is_off);
    } else if constexpr (std::is_same_v<Target, std::string>) {
        return options.text(o.name, o.value, help, target);
    } else if constexpr (std::is_same_v<Target, std::vector<std::string>>) {
        return options.list(o.name, o.value, help + "; may be given several times", target);
    } else if constexpr (std::is_same_v<Target, std::vector<Plane>>) {
        return options.each(o.name, o.value,
                            help +
                                "; z:2.5 is across the axis z at 2.5 mm, NX,NY,NZ:2.5 across a direction, 2.5 mm from "
                                "the origin along it; may be given several times",
                            target, parse_plane, "a plane such as z:2.5 or 1,0,1:2.5");
    } else if constexpr (std::is_same_v<Kind, form::Bytes>) {
        return options.value(o.name, o.value, help + "; such as 512M or 2G, too (powers of 1024)", target, parse_memory,
                             o.expected);
    } else if constexpr (std::is_same_v<Target, std::array<std::uint32_t, 3>>) {
        return options.value(o.name, o.value, help, target, parse_cells, o.expected);
    } else if constexpr (std::is_enum_v<Target>) {
        return options.choice(o.name, help, target, *member.kind.offered);
    } else if constexpr (std::is_integral_v<Target>) {
        return options.count(o.name, help, target, static_cast<std::uint64_t>(member.kind.low),
                             static_cast<std::uint64_t>(member.kind.high));
    } else if constexpr (std::is_same_v<Target, std::optional<Vec3>>) {
        return options.value(o.name, o.value, help, target, parse_vector,
                             std::string(*o.expected ? o.expected : "a point") +
                                 ": three numbers with commas between them, such as 10,0,-5");
    } else {
        const auto read = [rule = member.rule](const std::string& text) {
            auto number = parse_number(text);
            if (number && !allows(rule, *number)) number.reset();
            return number;
        };
        return options.value(o.name, o.value, help, target, read, o.expected);
    }
}

/// Defines the options of a struct's members that have this concern. Calls each(member, option) for each of them.
template <class S, class Each>
void define_members(Options& options, S& target, form::Concern concern, const Each& each) {
    form::for_members(form::of<S>, [&](const auto& member) {
        if constexpr (std::is_member_object_pointer_v<decltype(member.at)>) {
            using Target = std::remove_cvref_t<decltype(target.*member.at)>;
            if constexpr (!std::is_same_v<Target, Camera> &&
                          !std::is_same_v<std::remove_cvref_t<decltype(member.kind)>, form::Special>) {
                if (member.option.concern != concern || !*member.option.name) return;
                Option& option = define_member(options, member, target.*member.at);
                option.excludes = member.option.excludes;
                each(member, option);
            }
        }
    });
}
template <class S>
void define_members(Options& options, S& target, form::Concern concern) {
    define_members(options, target, concern, [](const auto&, const Option&) {});
}

}  // namespace csgrt::cli
