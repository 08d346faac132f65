// Conversion of C's structs by their descriptions (form/requests.hpp, form/answers.hpp). A struct's members have the
// order of the description's lines. A struct that may grow has its size before them.
#pragma once

#include <cstddef>
#include <cstring>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "c/call.hpp"
#include "form/answers.hpp"
#include "form/check.hpp"
#include "form/measure.hpp"
#include "form/requests.hpp"

namespace csgrt::c {

/// Reads or writes the members of a C struct one after the other, at the offsets that their alignments give. `Byte`:
/// const for reading.
template <class Byte>
class CMembers {
public:
    template <class C>
    explicit CMembers(C& of) : bytes_(reinterpret_cast<Byte*>(&of)), size_(sizeof(C)), alignment_(alignof(C)) {
        if constexpr (requires { of.size; }) place<std::size_t>();
    }
    template <class T>
    T next() {
        T value;
        std::memcpy(&value, place<T>(), sizeof(T));
        return value;
    }
    template <class T>
    void put(const T& value) {
        std::memcpy(place<T>(), &value, sizeof(T));
    }
    /// Throws unless the last member that was read or written is the struct's last.
    void expect_end(const char* name) const {
        if ((at_ + alignment_ - 1) / alignment_ * alignment_ != size_)
            throw std::logic_error(std::string(name) + ": the description has other members");
    }

private:
    template <class T>
    Byte* place() {
        at_ = (at_ + alignof(T) - 1) / alignof(T) * alignof(T);
        Byte* const place = bytes_ + at_;
        at_ += sizeof(T);
        return place;
    }

    Byte* bytes_;
    std::size_t size_, alignment_, at_ = 0;
};

template <class Member, class Value>
void read_member(CMembers<const std::byte>& members, const Member& member, Value& value, const std::string& name) {
    if constexpr (std::is_same_v<Value, bool>) {
        value = members.next<int>() != 0;
    } else if constexpr (std::is_same_v<Value, Vec3>) {
        value = of(members.next<csgrt_vec3>());
    } else if constexpr (std::is_same_v<Value, std::optional<Vec3>>) {
        value = of(members.next<const csgrt_vec3*>());
    } else if constexpr (std::is_same_v<Value, std::optional<double>>) {
        if (const auto given = members.next<double>(); given != 0) value = given;
    } else if constexpr (std::is_same_v<Value, std::string>) {
        value = text_or_empty(members.next<const char*>());
    } else if constexpr (std::is_same_v<Value, std::vector<std::string>>) {
        const auto first = members.next<const char* const*>();
        value = texts(first, members.next<std::size_t>(), name.c_str());
    } else if constexpr (std::is_same_v<Value, std::vector<Plane>>) {
        const auto first = members.next<const csgrt_plane*>();
        for (const csgrt_plane& plane : needed(first, members.next<std::size_t>(), name.c_str()))
            value.push_back({of(plane.normal), plane.distance});
    } else if constexpr (std::is_same_v<Value, std::vector<Density>>) {
        const auto first = members.next<const csgrt_density*>();
        for (const csgrt_density& row : needed(first, members.next<std::size_t>(), name.c_str()))
            value.push_back({row.material_id, text_or_empty(row.path), row.density, text_or_empty(row.name)});
    } else if constexpr (std::is_same_v<Value, std::vector<AllowedOverlap>>) {
        const auto first = members.next<const csgrt_allowed_overlap*>();
        for (const csgrt_allowed_overlap& row : needed(first, members.next<std::size_t>(), name.c_str()))
            value.push_back({&needed(row.first, name.c_str()), &needed(row.second, name.c_str())});
    } else if constexpr (std::is_same_v<Value, Camera>) {
        if (const auto camera = members.next<const csgrt_camera*>()) value = camera_of(camera);
    } else if constexpr (std::is_same_v<Value, std::optional<PixelRectangle>>) {
        if (const auto part = members.next<const csgrt_pixel_rectangle*>())
            value = *same_layout<const PixelRectangle>(part);
    } else if constexpr (std::is_same_v<Value, std::function<bool(double)>>) {
        const auto call = members.next<csgrt_progress>();
        void* const user = members.next<void*>();
        if (call) value = [call, user](double done) { return call(user, done) != 0; };
    } else if constexpr (std::is_enum_v<Value>) {
        value = choice(members.next<int>(), std::end(*member.kind.names)[-1].second, name.c_str());
    } else {
        value = members.next<Value>();
    }
}

/// Converts a C struct of this version (see read()) to the C++ struct.
template <class S, class C>
S described(const C& given, const char* name) {
    S all;
    CMembers<const std::byte> members(given);
    form::for_members(form::of<S>, [&](const auto& member) {
        read_member(members, member, form::member_of(member, all),
                    std::string(name) + "->" + std::string(member.key.member));
    });
    members.expect_end(name);
    return all;
}

/// The request of a call; a null pointer stands for `usual`.
template <class S, class C>
S request_of(const C* request, const C& usual) {
    return described<S>(request ? read(request, usual, "request") : usual, "request");
}

template <class Value>
void write_member(CMembers<std::byte>& members, const Value& value) {
    if constexpr (std::is_same_v<Value, bool> || std::is_enum_v<Value>) {
        members.put(static_cast<int>(value));
    } else if constexpr (std::is_same_v<Value, Vec3> || std::is_same_v<Value, Box> ||
                         std::is_same_v<Value, std::optional<Vec3>> || std::is_same_v<Value, Ray> ||
                         std::is_same_v<Value, Estimate>) {
        members.put(of(value));
    } else if constexpr (std::is_same_v<Value, std::optional<double>>) {
        members.put(value.value_or(0));
    } else if constexpr (std::is_same_v<Value, std::string>) {
        members.put(value.c_str());
    } else {
        static_assert(std::is_arithmetic_v<Value> || std::is_same_v<Value, std::array<std::uint32_t, 2>>);
        members.put(value);
    }
}

/// Converts a C++ struct to the C struct, which points to the C++ struct's texts and points.
template <class C, class S>
C shown(const S& of) {
    C all;
    std::memset(&all, 0, sizeof all);
    CMembers<std::byte> members(all);
    form::for_members(form::of<S>, [&](const auto& member) {
        using Kind = std::remove_cvref_t<decltype(member.kind)>;
        if constexpr (std::is_same_v<Kind, form::Listed>)
            members.put(form::member_of(member, of).size());
        else if constexpr (!std::is_same_v<Kind, form::Special>)
            write_member(members, form::member_of(member, of));
    });
    members.expect_end("the answer");
    return all;
}

}  // namespace csgrt::c
