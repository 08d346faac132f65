// Struct text: the parameters of some older solids, in databases of every form: key=value key="value" key=1,2,3
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include <csgrt/solids.hpp>

#include "formats/brlcad/objects.hpp"

namespace csgrt {

/// Reads such parameters by their keys. A missing or wrong value is a Fault at its position. `offset`: the text's
/// position.
class StructText {
public:
    StructText(std::string_view text, std::size_t offset);

    bool has(std::string_view key) const { return values_.count(key) != 0; }
    /// The position of the key's value. If the key is missing, the position of the text.
    std::size_t place_of(std::string_view key) const;
    std::string text(std::string_view key);
    int integer(std::string_view key, int low, int high);
    std::uint32_t count(std::string_view key);  ///< 1 or more
    double number(std::string_view key);
    Vec3 vec3(std::string_view key);
    /// Some programs omit the last row, which is then 0 0 0 1.
    Matrix matrix(std::string_view key);
    void end() const;

private:
    struct Value {
        std::string text;
        std::size_t offset = 0;
    };
    Value take(std::string_view key);
    std::size_t read_numbers(const Value& list, std::span<double> values) const;

    std::size_t offset_;
    std::map<std::string, Value, std::less<>> values_;
};

/// Readers of the solids that are written in this form.
BrlcadItem read_struct_ebm(StructText& p);
BrlcadItem read_struct_vol(StructText& p);
BrlcadItem read_struct_dsp(StructText& p);

}  // namespace csgrt
