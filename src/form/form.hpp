// Descriptions of structs: one description serves all code that handles a struct's members. For a scene these are
// JSON's reader and writer, the schema and the checks. For settings and views (requests.hpp) they are the command's
// options, C's structs, Python's attributes and the page's requests. A description, form::of<S>, has a line for each
// member: its names, a pointer to the member, its kind, a rule for its values, and a sentence on its meaning.
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

// ---- Kinds: a member's type, and its form in a file ----

struct Number {};
struct Length {};   ///< a number in the file's unit
struct Lengths {};  ///< a point or a displacement: a vector in the file's unit
struct Vector {};   ///< a vector that is not scaled by the file's unit
struct Axis {};     ///< a vector that is not scaled, of any length but 0
struct Color {};
struct Count {};  ///< a whole number from 0 to 2^32 - 1
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
    bool may_be_zero;  ///< a zero vector stays 0, and the checks report it
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
    std::size_t least = 0, most = std::numeric_limits<std::size_t>::max();  ///< numbers of items
};
template <class Item, class... Counts>  // a guide, because clang 14 deduces no aggregates
List(Item, Counts...)->List<Item>;
/// A list of one value for each of a mesh's `faces`, or one value for all.
template <class Item>
struct PerFace {
    Item item;
};
template <class Item>
PerFace(Item) -> PerFace<Item>;
struct Loops {};  ///< a face: one loop of indices, or a list of loops
struct Corners {
    std::size_t count;
};
struct Ends {};    ///< `start` and `end`, two indices
struct Curves {};  ///< a sketch's curves, and flags that tell which curves are reversed
struct Turn {};    ///< an angle in radians, which a file gives in degrees
/// Rows of numbers from 0 to `most`, as strings; with `marks`, '.' is 0 and '#' is `most`.
struct Cells {
    std::uint16_t most;
    bool marks;
};
/// A matrix. `lengths`: which columns the file's unit scales. The last column, a point, always is scaled. The columns
/// of x, y and z are scaled if these count cells or steps of height, and are not if these are lengths already.
struct Placement {
    std::array<bool, 4> lengths;
};
/// A whole number from `low` to `high`. If `low` is above 0, the number 0 means "not given".
struct Amount {
    std::uint64_t low = 0, high = std::numeric_limits<std::uint64_t>::max();
};
struct Bytes {};  ///< an amount of memory; the command also reads "2G"
struct Texts {};
struct Boxed {};  ///< a box: its low and its high corner
struct Planes {};
/// A value of an enumeration, by its name in a table (form/names.hpp).
template <class Names, class Offered = Names>
struct Named {
    const Names* names;
    const Offered* offered;  ///< the names that the command accepts
    constexpr Named(const Names* all) : names(all), offered(all) {}
    constexpr Named(const Names* all, const Offered* some) : names(all), offered(some) {}
};
template <class Names>
Named(const Names*) -> Named<Names>;
/// A member that each interface handles with its own code.
struct Special {};
struct Listed {};  ///< a list in an answer: C has its length, and a call for an item
/// A member whose reader is handwritten. `schema`: its text in the schema.
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
inline constexpr Listed listed{};
inline constexpr Whole byte{0, 255};
inline constexpr Whole integer{std::numeric_limits<int>::min(), std::numeric_limits<int>::max()};
template <class S>
inline constexpr Object<S> object{};

// ---- Rules: the allowed values. `called`: the member's name at the beginning of an error's sentence ----

struct Any {};
/// The bounds of a number, or of each number of a list.
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
/// The rule that a vector's length is not 0.
struct Nonzero {
    const char* called;
};
constexpr Nonzero nonzero(const char* called = "") { return {called}; }
/// The rule that a vector's length is not 0, and that the vector is perpendicular to another one.
template <class S>
struct Across {
    const char* called;
    Vec3 S::*other;
    const char* other_called;
};
template <class S>
Across(const char*, Vec3 S::*, const char*) -> Across<S>;
/// The rule of the third of three axes: the axes span a volume.
template <class S>
struct Spanning {
    Vec3 S::*axes[3];
    const char* called[3];
};
/// The words for a list of objects in errors: their name, the text before an object's number, and the sentence about
/// too short a list (null: other checks report it).
struct Items {
    const char* called;
    const char* before;
    const char* fewer;
};

// ---- Members ----

enum class Given : std::uint8_t {
    required,
    optional,  ///< has a default; the writer leaves the default out
    filled,    ///< has a default; the writer always writes the member
};

/// A member's names: in JSON, in code, and in those of BRL-CAD's databases that hold a solid's numbers in a row.
struct Key {
    std::string_view json;
    const char* brlcad = "";
    std::string_view member = json;  ///< the name in C++, C and Python
    constexpr Key(std::string_view in_json) : json(in_json) {}
    constexpr Key(const char* in_json, const char* in_brlcad = "") : json(in_json), brlcad(in_brlcad) {}
    constexpr Key(const char* in_json, const char* in_brlcad, const char* in_code)
        : json(in_json), brlcad(in_brlcad), member(in_code) {}
};

/// A member's group. A command has the options of some groups.
enum class Concern : std::uint8_t {
    model,    ///< the model
    work,     ///< the devices and the resources that compute
    either,   ///< as `work`, for commands that compute on a device or on the reference
    picture,  ///< the picture
};

/// The command's option that sets a member. Without a name, there is no option, or handwritten code defines it.
struct Option {
    Concern concern = Concern::picture;
    const char* name = "";
    const char* value = "";     ///< the value's name in the help; flags and choices have none
    const char* absent = "";    ///< the words before "if not given" in the help
    const char* expected = "";  ///< the words after "expected" in an error; "": the kind's
    const char* excludes = "";  ///< the name of an option that must not be given, too
    bool changes_answers = true;
    bool is_off = false;  ///< the flag sets false
};

/// One line of a description. `At`: a pointer to the member, or a function object that takes the struct.
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

/// Stands for no member.
struct Nothing {};
inline constexpr Nothing nothing{};
/// Stands for the struct itself.
struct Itself {
    constexpr auto& operator()(auto& s) const { return s; }
};
inline constexpr Itself itself{};
/// Stands for a member of a member.
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

/// The head of a description. `name`: of the schema's definition, and for a solid its "type".
struct Head {
    const char* name;
    const char* about;
    bool has_type;
    bool is_model;  ///< true: validation of the scene checks the values; false: the reader does
};
constexpr Head solid(const char* called, const char* about = "") { return {called, about, true, true}; }
constexpr Head part(const char* called, const char* about = "") { return {called, about, false, true}; }
/// A solid with simple parameters, such as a box or a sphere, which JSON's reader turns into one of the model's solids.
constexpr Head simple(const char* called, const char* about = "") { return {called, about, true, false}; }
/// An object in a file that is not a solid.
constexpr Head plain(const char* called, const char* about = "") { return {called, about, false, false}; }

template <class... Members>
struct Form {
    Head head;
    std::tuple<Members...> members;
    constexpr explicit Form(Head h, Members... m) : head(h), members(m...) {}
};

struct Undescribed {};
/// The description of S. Code that uses it for a struct without a description does not compile.
template <class S>
inline constexpr auto of = Undescribed{};

template <class Each, class... Members>
constexpr void for_members(const Form<Members...>& form, Each each) {
    std::apply([&](const auto&... member) { (each(member), ...); }, form.members);
}

/// The described member of a struct.
template <class Member, class S>
constexpr auto& member_of(const Member& member, S& s) {
    return std::invoke(member.at, s);
}

/// The struct's defaults, which hold for members that a file does not give.
template <class S>
S usual() {
    return {};
}

}  // namespace csgrt::form
