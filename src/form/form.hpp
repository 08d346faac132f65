// How the members of a struct are described: once, for all that goes over them. Of a scene these are JSON's reader and
// writer, the schema and the checks; of what a caller asks for (requests.hpp), the command's options, C's structs,
// Python's attributes and the page's requests. A description, form::of<S>, has a line a member: its keys, where it is
// in the struct, its kind, what is allowed, and what it means.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string_view>
#include <tuple>

#include <csgrt/scene.hpp>

namespace csgrt::form {

// ---- Kinds: what a member is, and how a file writes it ----

struct Number {};
struct Length {};   ///< a number in the file's unit
struct Lengths {};  ///< a place, or the way from one to another: a vector in the file's unit
struct Vector {};   ///< as it stands
struct Axis {};     ///< the same, of any length but 0
struct Color {};
struct Count {};  ///< from 0 to 2^32 - 1
struct Whole {
    int low, high;
};
struct Flag {};
struct Text {};
struct Name {};      ///< a text that is not empty
struct Triangle {};  ///< three indices
struct Uv {};        ///< two lengths
/// A vector that is made a unit vector.
struct Direction {
    bool may_be_zero;  ///< and stays it, for the checks to find
};
/// The values of an enumeration from `first` on.
template <std::size_t count>
struct Words {
    std::array<std::string_view, count> words;
    std::size_t first = 0;
};
/// An object of the form of<S>.
template <class S>
struct Object {};
template <class Item>
struct List {
    Item item;
    std::size_t least = 0, most = std::numeric_limits<std::size_t>::max();  ///< items
};
template <class Item, class... Counts>  // clang 14 deduces no aggregates
List(Item, Counts...)->List<Item>;
/// A list of one value for each of a mesh's `faces`, or one value for all.
template <class Item>
struct PerFace {
    Item item;
};
template <class Item>
PerFace(Item) -> PerFace<Item>;
struct Loops {};  ///< of a face: one loop of indices, or a list of loops
struct Corners {
    std::size_t count;
};
struct Ends {};    ///< `start` and `end`, two indices
struct Curves {};  ///< of a sketch, with what says that one is reversed
struct Turn {};    ///< an angle in radians, which a file gives in degrees
/// Rows of numbers from 0 to `most`, as strings; with `marks`, '.' is 0 and '#' is `most`.
struct Cells {
    std::uint16_t most;
    bool marks;
};
/// A matrix, and which of its columns are lengths. The last one, a place, always is; x, y and z are if they count cells
/// or steps of height, and are not if they are millimetres already.
struct Placement {
    std::array<bool, 4> lengths;
};
/// A whole number of a type of its own, from `low` on, which stands for "not given" where it is 0 and `low` is not.
struct Amount {
    std::uint64_t low = 0, high = std::numeric_limits<std::uint64_t>::max();
};
struct Bytes {};  ///< of memory, which the command takes as "2G", too
struct Texts {};
struct Boxed {};  ///< a box: its low and its high corner
struct Planes {};
/// One of a table's values, which has a name (form/names.hpp).
template <class Names, class Offered = Names>
struct Named {
    const Names* names;
    const Offered* offered;  ///< those that the command takes
    constexpr Named(const Names* all) : names(all), offered(all) {}
    constexpr Named(const Names* all, const Offered* some) : names(all), offered(some) {}
};
template <class Names>
Named(const Names*) -> Named<Names>;
/// What each interface has by hand.
struct Special {};
/// What only the schema is told; its reader is written by hand.
struct Other {
    const char* schema;
};

inline constexpr Number number{};
inline constexpr Length length{};
inline constexpr Lengths lengths{};
inline constexpr Vector vector{};
inline constexpr Axis axis{};
inline constexpr Color color{};
inline constexpr Count count{};
inline constexpr Flag flag{};
inline constexpr Text text{};
inline constexpr Name name{};
inline constexpr Triangle triangle{};
inline constexpr Direction direction{true}, normal{false};
inline constexpr Amount amount{};
inline constexpr Bytes bytes{};
inline constexpr Texts texts{};
inline constexpr Planes planes{};
inline constexpr Boxed box{};
inline constexpr Special special{};
inline constexpr Whole byte{0, 255};
inline constexpr Whole integer{std::numeric_limits<int>::min(), std::numeric_limits<int>::max()};
template <class S>
inline constexpr Object<S> object{};

// ---- Rules: what is allowed. A fault's sentence begins with what the member is called. ----

struct Any {};
/// Of a number, or of each number of a list.
struct Bounds {
    double low, high;
    bool with_low, with_high;
    const char* called;
    const char* sentence;

    constexpr bool hold(double x) const {
        return (with_low ? x >= low : x > low) && (with_high ? x <= high : x < high);
    }
};
constexpr double unlimited = std::numeric_limits<double>::infinity();
constexpr Bounds positive(const char* called = "") {
    return {0, unlimited, false, true, called, "must be greater than 0"};
}
constexpr Bounds not_negative(const char* called = "") {
    return {0, unlimited, true, true, called, "must be 0 or more"};
}
/// Of a vector: a length other than 0.
struct Nonzero {
    const char* called;
};
constexpr Nonzero nonzero(const char* called = "") { return {called}; }
/// The same, and perpendicular to another.
template <class S>
struct Across {
    const char* called;
    Vec3 S::*other;
    const char* other_called;
};
template <class S>
Across(const char*, Vec3 S::*, const char*) -> Across<S>;
/// Of the third of three axes: they span a volume.
template <class S>
struct Spanning {
    Vec3 S::*axes[3];
    const char* called[3];
};
/// Of a list of objects: what they are called, what comes before their numbers in sentences, and the sentence about
/// fewer than the least (null: other checks tell).
struct Items {
    const char* called;
    const char* before;
    const char* fewer;
};

// ---- Members ----

enum class Given : std::uint8_t {
    required,
    optional,  ///< has a default, with which it is not written
    filled,    ///< has a default, and is written
};

/// What a member is called: in JSON, and in BRL-CAD's databases, if those have a solid's numbers one after another.
struct Key {
    std::string_view json;
    const char* brlcad = "";
    std::string_view member = json;  ///< in C++, C and Python
    constexpr Key(std::string_view in_json) : json(in_json) {}
    constexpr Key(const char* in_json, const char* in_brlcad = "") : json(in_json), brlcad(in_brlcad) {}
    constexpr Key(const char* in_json, const char* in_brlcad, const char* in_code)
        : json(in_json), brlcad(in_brlcad), member(in_code) {}
};

/// What a member concerns: a command has the options of some of these groups.
enum class Concern : std::uint8_t {
    model,    ///< what the model is
    work,     ///< who computes, and with how much
    either,   ///< the same, of commands that compute on a device or on the reference
    picture,  ///< what a picture shows
};

/// The command's option that sets a member. No name: there is none, or it is made by hand.
struct Option {
    Concern concern = Concern::picture;
    const char* name = "";
    const char* value = "";     ///< what its value is called; flags and choices need none
    const char* absent = "";    ///< what holds "if not given"
    const char* expected = "";  ///< what a wrong value is not; "": as the kind says
    const char* excludes = "";  ///< another option's name
    bool changes_answers = true;
    bool is_off = false;  ///< a flag that sets false
};

/// `At`: a pointer to the member, or what is called with the struct.
template <Given how, class At, class Kind, class Rule>
struct Member {
    static constexpr Given given = how;
    Key key;
    At at;
    Kind kind;
    Rule rule;
    const char* help;
    Option option = {};
};

/// No member: what goes over the members passes over it.
struct Nothing {};
inline constexpr Nothing nothing{};
/// The struct.
struct Itself {
    constexpr auto& operator()(auto& s) const { return s; }
};
inline constexpr Itself itself{};
/// A member's member.
template <class Outer, class Inner>
struct Inside {
    Outer outer;
    Inner inner;
    constexpr auto& operator()(auto& s) const { return s.*outer.*inner; }
};
template <class Outer, class Inner>
Inside(Outer, Inner) -> Inside<Outer, Inner>;

template <Given given>
struct Maker {
    template <class At, class Kind>
    constexpr Member<given, At, Kind, Any> operator()(Key key, At at, Kind kind, const char* help = "") const {
        return {key, at, kind, {}, help};
    }
    template <class At, class Kind>
    constexpr Member<given, At, Kind, Any> operator()(Key key, At at, Kind kind, const char* help,
                                                      Option option) const {
        return {key, at, kind, {}, help, option};
    }
    template <class At, class Kind, class Rule>
    constexpr Member<given, At, Kind, Rule> operator()(Key key, At at, Kind kind, Rule rule, const char* help,
                                                       Option option) const {
        return {key, at, kind, rule, help, option};
    }
    template <class At, class Kind, class Rule>
    constexpr Member<given, At, Kind, Rule> operator()(Key key, At at, Kind kind, Rule rule,
                                                       const char* help = "") const {
        return {key, at, kind, rule, help};
    }
};
inline constexpr Maker<Given::required> required{};
inline constexpr Maker<Given::optional> optional{};
inline constexpr Maker<Given::filled> filled{};

// ---- Forms ----

/// The name is that of the schema's definition, and of a solid's "type".
struct Head {
    const char* name;
    const char* about;
    bool has_type;
    bool is_model;  ///< checked when the scene is validated; others by their reader
};
constexpr Head solid(const char* called, const char* about = "") { return {called, about, true, true}; }
constexpr Head part(const char* called, const char* about = "") { return {called, about, false, true}; }
/// A solid by the numbers that a person knows: JSON's reader makes one of the model's of it.
constexpr Head simple(const char* called, const char* about = "") { return {called, about, true, false}; }
/// An object of a file that is no solid.
constexpr Head plain(const char* called, const char* about = "") { return {called, about, false, false}; }

template <class... Members>
struct Form {
    Head head;
    std::tuple<Members...> members;
    constexpr explicit Form(Head h, Members... m) : head(h), members(m...) {}
};

struct Undescribed {};
/// The description of S; a struct without one does not compile where it is asked for.
template <class S>
inline constexpr auto of = Undescribed{};

template <class Each, class... Members>
constexpr void for_members(const Form<Members...>& form, Each each) {
    std::apply([&](const auto&... member) { (each(member), ...); }, form.members);
}

/// A member of a struct, which `at` points at or is called with.
template <class Member, class S>
constexpr auto& member_of(const Member& member, S& s) {
    return std::invoke(member.at, s);
}

/// What a file means that does not give optional members.
template <class S>
S usual() {
    return {};
}

}  // namespace csgrt::form
