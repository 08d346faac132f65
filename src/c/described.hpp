// C's structs by their descriptions (form/requests.hpp): their members stand in the order of its lines.
#pragma once

#include <cstddef>
#include <cstring>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "c/call.hpp"
#include "form/requests.hpp"

namespace csgrt::c {

/// The members of a C struct, one after the other, each where its alignment has it.
class CMembers {
public:
    template <class C>
    explicit CMembers(const C& of) : bytes_(reinterpret_cast<const std::byte*>(&of)) {
        next<std::size_t>();  // the size
    }
    template <class T>
    T next() {
        at_ = (at_ + alignof(T) - 1) / alignof(T) * alignof(T);
        T value;
        std::memcpy(&value, bytes_ + at_, sizeof(T));
        at_ += sizeof(T);
        return value;
    }
    /// Behind the last member. The struct ends there, but for its alignment.
    std::size_t end() const { return at_; }

private:
    const std::byte* bytes_;
    std::size_t at_ = 0;
};

template <class Member, class Value>
void read_member(CMembers& members, const Member& member, Value& value, const std::string& name) {
    if constexpr (std::is_same_v<Value, bool>) {
        value = members.next<int>() != 0;
    } else if constexpr (std::is_same_v<Value, std::string>) {
        value = text_or_empty(members.next<const char*>());
    } else if constexpr (std::is_same_v<Value, std::vector<std::string>>) {
        const auto first = members.next<const char* const*>();
        value = texts(first, members.next<std::size_t>(), name.c_str());
    } else if constexpr (std::is_same_v<Value, std::vector<Plane>>) {
        const auto first = members.next<const csgrt_plane*>();
        for (const csgrt_plane& plane : needed(first, members.next<std::size_t>(), name.c_str()))
            value.push_back({of(plane.normal), plane.distance});
    } else if constexpr (std::is_same_v<Value, Camera>) {
        if (const auto camera = members.next<const csgrt_camera*>()) value = camera_of(camera);
    } else if constexpr (std::is_same_v<Value, std::optional<PixelRectangle>>) {
        if (const auto part = members.next<const csgrt_pixel_rectangle*>())
            value = {part->left, part->top, part->width, part->height};
    } else if constexpr (std::is_same_v<Value, std::function<bool(double)>>) {
        const auto call = members.next<csgrt_progress>();
        void* const user = members.next<void*>();
        if (call) value = [call, user](double done) { return call(user, done) != 0; };
    } else if constexpr (std::is_enum_v<Value>) {
        Value last{};
        for (const auto& [text, named] : *member.kind.names) last = std::max(last, named);
        value = choice(members.next<int>(), last, name.c_str());
    } else {
        value = members.next<Value>();
    }
}

/// The C++ struct of a C one, of this version (see read()).
template <class S, class C>
S described(const C& given, const char* name) {
    S all;
    CMembers members(given);
    form::for_members(form::of<S>, [&](const auto& member) {
        read_member(members, member, all.*member.at, std::string(name) + "->" + std::string(member.key.member));
    });
    if ((members.end() + alignof(C) - 1) / alignof(C) * alignof(C) != sizeof(C))
        throw std::logic_error(std::string(name) + ": the description has other members");
    return all;
}

}  // namespace csgrt::c
