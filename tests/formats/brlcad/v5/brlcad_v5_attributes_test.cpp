// Attributes by themselves: spellings and which of them holds.
#include "catch.hpp"
#include "formats/brlcad/v5/attributes.hpp"
#include "formats/text_source.hpp"

using namespace csgrt;

namespace {

Combination with(const std::vector<Attribute>& attributes) {
    Combination combination;
    const TextSource source("attributes", {});
    Findings findings(source);
    set_attributes(combination, attributes, findings);
    findings.throw_if_any();
    return combination;
}

}  // namespace

TEST_CASE("attributes: the standard spelling holds, wherever it stands", "[attributes]") {
    const Attribute standard{"shader", {"glass"}}, other{"oshader", {"mirror"}};
    CHECK(with({standard, other}).finish->shader == "glass");
    CHECK(with({other, standard}).finish->shader == "glass");
    CHECK(with({other}).finish->shader == "mirror");
    CHECK(with({{"color", {"255/0/0"}}, {"rgb", {"0/255/0"}}}).color == Vec3{1, 0, 0});
    CHECK(with({{"region_id", {"7"}}, {"id", {"8"}}}).region_id == 7);
}

TEST_CASE("attributes: unknown keys are passed over or told", "[attributes]") {
    CHECK_FALSE(with({{"color of the sky", {"blue"}}}).color);
    Combination combination;
    CHECK_FALSE(set_attribute(combination, {"unknown", {"1"}}));
    CHECK(set_attribute(combination, {"REGION", {"yes"}}));
    CHECK(combination.region);
}
