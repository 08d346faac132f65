#include "catch.hpp"
#include "thrown.hpp"

#include <concepts>
#include <span>
#include <utility>

#include <csgrt/image.hpp>

using namespace csgrt;

namespace {

template <class Picture>
concept has_channels = requires(Picture picture) {
    std::forward<Picture>(picture).channel("Z");
};

// A range-for over the channel of a call's result would read memory that is gone.
static_assert(has_channels<Image&> && has_channels<const Image&>);
static_assert(!has_channels<Image> && !has_channels<const Image>);
static_assert(std::same_as<decltype(std::declval<Image&>().channel("Z")), std::span<const float>>);

Image two_channels() {
    Image image{.width = 2, .height = 1, .names = {"Z", "region"}, .are_ids = {false, true}};
    image.channels = Channels({{1.5f, 2.5f}, {0.0f, 0.0f}});
    image.channels.ids(1)[1] = 16'777'217;  // which is no float
    return image;
}

}  // namespace

TEST_CASE("a channel is found by its name, and is the picture's own memory", "[image]") {
    const Image image = two_channels();
    CHECK(image.ids("region")[0] == 0);
    CHECK(image.ids("region")[1] == 16'777'217);
    CHECK_THROWS_WITH(image.channel("region"), "the channel 'region' holds ids: see Image::ids()");
    CHECK_THROWS_WITH(image.ids("Z"), "the channel 'Z' holds floats: see Image::channel()");
    CHECK(image.channel("Z").data() == image.channels[0].data());
    CHECK(image.channel("Z").size() == 2);
    CHECK(image.has_channel("Z"));
    CHECK(image.has_channel("region"));
    CHECK_FALSE(image.has_channel("z"));
    CHECK_FALSE(Image{}.has_channel(""));
}

TEST_CASE("a channel that the picture has not is an error that names those it has", "[image][promise:pictures]") {
    const Image image = two_channels(), empty;
    CHECK(test::failure(Status::usage, [&] { image.channel("depth"); }) ==
          "the picture has no channel 'depth'; it has Z region");
    CHECK_THROWS_WITH(empty.channel("Z"), "the picture has no channel 'Z'; it has none");
}
