// BRL-CAD's models as binary databases: the same as their text twins.
#include "formats/brlcad/asc.hpp"
#include "formats/brlcad/g/reader.hpp"
#include "formats/brlcad/brlcad_models.hpp"
#include "formats/brlcad/brlcad_twins.hpp"
#include "formats/same_scene.hpp"

using namespace csgrt;
using namespace csgrt::brlcad_test;

namespace {

// Every text among the models holds its numbers with as many digits as the binary needs, but for the computed ones of a
// torus's axis: made a unit vector, they may differ in the last bits.
constexpr double torus_gap = 1e-15;

void check_solid(const Solid& binary, const Solid& text) {
    REQUIRE(binary.shape.index() == text.shape.index());
    CHECK_FALSE(std::holds_alternative<Unsupported>(text.shape));  // or there would be nothing to compare
    Shape a = plain(binary.shape), b = plain(text.shape);
    if (auto* tor = std::get_if<Tor>(&a)) {
        Vec3 &axis = tor->h, &other = std::get<Tor>(b).h;
        CHECK(std::hypot(axis.x - other.x, axis.y - other.y, axis.z - other.z) <= torus_gap);
        axis = other;
    }
    CHECK(same_shape(a, b));
}

void check_combination(const Combination& binary, const Combination& text) {
    const PlainTree a = plain(binary.tree), b = plain(text.tree);
    CHECK(a.text == b.text);
    CHECK(a.matrices == b.matrices);
    CHECK(binary.region == text.region);
    CHECK(binary.region_id == text.region_id);
    CHECK(binary.air == text.air);
    // Release 4 writes 0 for what is not given.
    if (text.material_id != 0) CHECK(binary.material_id == text.material_id);
    if (text.los != 0) CHECK(binary.los == text.los);
    CHECK(binary.color == text.color);
    CHECK(binary.color_inherits == text.color_inherits);
    CHECK(binary.finish_inherits == text.finish_inherits);
    REQUIRE(binary.finish.has_value() == text.finish.has_value());
    if (!text.finish) return;
    CHECK(binary.finish->shader == text.finish->shader);
    CHECK(binary.finish->shine == text.finish->shine);
    CHECK(binary.finish->specular == text.finish->specular);
    CHECK(binary.finish->diffuse == text.finish->diffuse);
    CHECK(binary.finish->transmit == text.finish->transmit);
    CHECK(binary.finish->reflect == text.finish->reflect);
}

/// The files are `base`.g and `base`.asc. Their objects may stand in another order.
Scene check_twins(const std::filesystem::path& base) {
    const Scene binary = read_brlcad_g(base.string() + ".g"), text = read_brlcad_asc(base.string() + ".asc");
    CHECK(binary.title == text.title);
    CHECK(binary.units == text.units);
    CHECK(binary.objects.size() == text.objects.size());
    REQUIRE(binary.region_colors.size() == text.region_colors.size());
    for (std::size_t i = 0; i < text.region_colors.size(); ++i) {
        CHECK(binary.region_colors[i].low == text.region_colors[i].low);
        CHECK(binary.region_colors[i].high == text.region_colors[i].high);
        CHECK(binary.region_colors[i].color == text.region_colors[i].color);
    }
    std::map<std::string, const Object*> index;
    for (const Object& object : binary.objects) index[name_of(object)] = &object;
    for (const Object& object : text.objects) {
        INFO(name_of(object));
        const Object* twin = index[name_of(object)];
        REQUIRE(twin != nullptr);
        REQUIRE(twin->index() == object.index());
        if (const auto* solid = std::get_if<Solid>(&object)) {
            check_solid(std::get<Solid>(*twin), *solid);
        } else {
            check_combination(std::get<Combination>(*twin), std::get<Combination>(object));
        }
    }
    return binary;
}

}  // namespace

TEST_CASE("g: BRL-CAD's models are those of their texts", "[g][models]") {
    const auto folder = model_folder();
    if (folder.empty()) return;
    for (const Model& model : models) {
        INFO(model.file);
        check_counts(check_twins(folder / model.file), model);
    }
}

TEST_CASE("g: every solid that a text can hold", "[g][models]") {
    const std::string truth = test::folder("CSGRT_TRUTH");
    if (truth.empty()) return;
    for (const char* file : {"solids", "solids_csg"}) {
        INFO(file);
        check_twins(std::filesystem::path(truth) / "solids" / file);
    }
}
