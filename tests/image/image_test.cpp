#include "catch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <thread>

#include <unistd.h>

#include <OpenImageIO/imageio.h>

#include <csgrt/csgrt.hpp>

#include "folder.hpp"
#include "image/encode.hpp"
#include "image/whole.hpp"
#include "thrown.hpp"

using namespace csgrt;
using test::Folder;
namespace fs = std::filesystem;

namespace {

Image full_picture() {
    Image image;
    image.width = 7;
    image.height = 5;
    image.names = {"R", "G", "B", "A", "Z", "N.X", "N.Y", "N.Z", "region", "solid", "depth", "partitions", "overlap"};
    image.channels = Channels(35, std::vector<float>(image.names.size()));
    for (std::size_t c = 0; c < image.names.size(); ++c)
        for (std::size_t i = 0; i < 35; ++i)
            image.channels[c][i] = static_cast<float>(c) * 1000 + static_cast<float>(i) + 1 / 3.0f;
    image.channels[4][6] = std::numeric_limits<float>::infinity();
    image.channels[5][7] = -std::numeric_limits<float>::denorm_min();
    image.are_ids.resize(10);
    for (const std::size_t c : {std::size_t{8}, std::size_t{9}}) {
        image.are_ids[c] = true;
        for (std::uint32_t i = 0; i < 35; ++i) image.channels.ids(c)[i] = 0xffffffff - i;  // no float tells them apart
    }
    image.attributes = {{"csgrt:title", "a \"title\" \xc3\xa4"}, {"csgrt:version", "1"}};
    image.matrices["worldToCamera"] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16};
    image.matrices["cameraToScreen"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    return image;
}

Image gray(std::vector<float> values) {
    Image image;
    image.width = static_cast<int>(values.size());
    image.height = 1;
    image.names = {"R", "G", "B"};
    image.channels = std::vector<std::vector<float>>{values, values, values};
    return image;
}

}  // namespace

TEST_CASE("an EXR keeps every channel, bit by bit, and the header", "[image][promise:pictures]") {
    const Folder folder;
    const Image written = full_picture();
    write_image(written, folder / "picture.exr");
    CHECK(folder.files().size() == 1);
    const Image read = read_image(folder / "picture.exr");
    CHECK(read.width == 7);
    CHECK(read.height == 5);
    CHECK(read.names == written.names);
    for (std::size_t c = 0; c < read.names.size(); ++c) CHECK(read.holds_ids(c) == written.holds_ids(c));
    REQUIRE(read.channels.size() == written.channels.size());
    for (std::size_t c = 0; c < read.channels.size(); ++c) {
        INFO(read.names[c]);
        REQUIRE(read.channels[c].size() == 35);
        CHECK(std::memcmp(read.channels[c].data(), written.channels[c].data(), 35 * sizeof(float)) == 0);
    }
    CHECK(read.attributes == written.attributes);
    CHECK(read.matrices == written.matrices);
}

TEST_CASE("a matrix stands in the EXR as OpenEXR wants it, for row vectors", "[image]") {
    const std::vector<unsigned char> bytes = encode(full_picture(), "exr", "test");
    const std::string text(bytes.begin(), bytes.end());
    const std::string key = std::string("worldToCamera") + '\0' + "m44f" + '\0';
    const std::size_t at = text.find(key);
    REQUIRE(at != std::string::npos);
    float first[4];
    std::memcpy(first, text.data() + at + key.size() + 4, sizeof first);
    CHECK(std::vector<float>(first, first + 4) == std::vector<float>{1, 5, 9, 13});
}

TEST_CASE("channels that csgrt does not know keep their place after those it knows", "[image][promise:pictures]") {
    const Folder folder;
    Image image = gray({0.5f});
    image.names = {"extra", "Z", "G"};
    write_image(image, folder / "a.exr");
    CHECK(read_image(folder / "a.exr").names == std::vector<std::string>{"G", "Z", "extra"});
}

TEST_CASE("a PNG says that it is sRGB and has alpha where a pixel is not opaque", "[image][promise:colors]") {
    Image image = gray({0.5f, 0.25f});
    const auto file = [&] {
        const std::vector<unsigned char> bytes = encode(image, "png", "test");
        return std::string(bytes.begin(), bytes.end());
    };
    constexpr char rgb = 2, rgba = 6;  // the header's type of colour
    constexpr std::size_t type_at = 25;
    const std::string srgb{'\0', '\0', '\0', '\1', 's', 'R', 'G', 'B'},
        gamma{'g', 'A', 'M', 'A', '\0', '\0', '\xb1', '\x8f'};
    CHECK(file().find(srgb) != std::string::npos);
    CHECK(file().find(gamma) != std::string::npos);  // 45455: what sRGB is for readers that do not know it
    CHECK(file().find("cHRM") != std::string::npos);
    CHECK(file()[type_at] == rgb);
    image.names.emplace_back("A");
    image.channels = std::vector<std::vector<float>>{{0.5f, 0.25f}, {0.5f, 0.25f}, {0.5f, 0.25f}, {1, 1}};
    CHECK(file()[type_at] == rgb);
    image.channels[3][1] = 0.5f;
    CHECK(file()[type_at] == rgba);
    CHECK(file().find(srgb) != std::string::npos);
}

TEST_CASE("EXR and PNG of one picture look the same, however it was drawn", "[image][promise:colors]") {
    const Folder folder;
    const char* scenes = std::getenv("CSGRT_SCENES");
    REQUIRE(scenes != nullptr);
    const Scene scene = load_scene(std::string(scenes) + "/operators.json");
    Settings settings{.reference = true, .display_shading = GENERATE(false, true)};
    View view{.width = 60, .height = 50, .camera = scene.camera, .every_partition = false};
    view.transparent = GENERATE(false, true);
    INFO("display shading " << settings.display_shading << ", transparent " << view.transparent);
    Image image = Renderer(scene, {}, settings).render(view);
    if (view.transparent)  // a veil over the upper half, as a viewer may blend it; associated
        for (std::size_t c = 0; c < 4; ++c)
            for (std::size_t i = 0; i < 60 * 25; ++i) image.channels[c][i] *= 0.75f;
    write_image(image, folder / "a.exr");
    write_image(image, folder / "a.png");
    const Image exr = read_image(folder / "a.exr");
    CHECK_FALSE(exr.display_values);

    OIIO::ImageSpec as_it_is;
    as_it_is.attribute("oiio:UnassociatedAlpha", 1);
    const auto png = OIIO::ImageInput::open(folder / "a.png", &as_it_is);
    REQUIRE(png);
    const auto count = static_cast<std::size_t>(png->spec().nchannels);
    CHECK(count == (view.transparent ? 4 : 3));
    CHECK(png->spec().get_string_attribute("oiio:ColorSpace") == "sRGB");
    std::vector<unsigned char> bytes(count * 60 * 50);
    REQUIRE(png->read_image(0, 0, 0, -1, OIIO::TypeUInt8, bytes.data()));
    std::size_t seen = 0, far = 0;
    for (std::size_t i = 0; i < 60 * 50; ++i) {
        const double alpha = exr.channels[3][i];
        if (count == 4) far += bytes[4 * i + 3] != int(255 * alpha + 0.5);
        for (std::size_t c = 0; c < 3; ++c) {
            const double light = std::min(exr.channels[c][i] / std::max(alpha, 0.5), 1.0);
            const double display = light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
            far += std::abs(bytes[count * i + c] - 255 * display) > 0.501;
            seen += bytes[count * i + c] > 60;
        }
    }
    CHECK(far == 0);
    CHECK(seen > 500);
    // Shown as they are, the values that were shaded are the bytes.
    if (settings.display_shading && !view.transparent)
        for (std::size_t i = 0; i < 60 * 50; ++i)
            CHECK(bytes[3 * i] == int(255 * double(std::min(image.channels[0][i], 1.0f)) + 0.5));
}

TEST_CASE("the same picture gives the same bytes at any time", "[image]") {
    const Image image = full_picture();
    const std::vector<unsigned char> exr = encode(image, "exr", "test"), png = encode(image, "png", "test");
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // dates have whole seconds
    CHECK(encode(image, "exr", "test") == exr);
    CHECK(encode(image, "png", "test") == png);
}

TEST_CASE("who follows the writing of an EXR gets the same bytes, and may end it", "[image]") {
    const Folder folder;
    const std::string file = folder.write("a.exr", "old");
    Image image = full_picture();
    image.width = 3;
    image.height = 5000;
    image.channels = Channels(15'000, std::vector<float>(image.names.size(), 0.1f));
    double last = -1;
    int calls = 0;
    const auto grows = [&](double part) {
        ++calls;
        return part > std::exchange(last, part) && part < 1;
    };
    CHECK(encode(image, "exr", "test", grows) == encode(image, "exr", "test"));
    CHECK(calls > 1);
    CHECK(test::failure(Status::interrupted, [&] {
              write_image(image, file, "exr", [](double part) { return part < 0.5; });
          }) == "interrupted");
    CHECK(test::read_file(file) == "old");
    CHECK(folder.files().size() == 1);
}

TEST_CASE("a file is replaced whole, and left alone when writing fails", "[image][promise:files]") {
    const Folder folder;
    std::ofstream(folder / "a.png") << "old";
    write_image(gray({1, 0}), folder / "a.png");
    CHECK(test::read_file(folder / "a.png").starts_with("\x89PNG"));
    CHECK(folder.files().size() == 1);

    std::ofstream(folder / "b.png") << "old";
    Image broken = gray({1, 0});
    broken.width = 3;
    CHECK_THROWS_AS(write_image(broken, folder / "b.png"), Error);
    CHECK(test::read_file(folder / "b.png") == "old");

    // A folder in the file's place: the temporary file is written, the rename fails, the temporary file goes.
    fs::create_directory(folder / "c.png");
    const std::string text = test::failure(Status::file, [&] { write_image(gray({1}), folder / "c.png"); });
    CHECK(text == (folder / "c.png") + ": cannot replace: Is a directory");
    CHECK(folder.files().size() == 3);
}

TEST_CASE("a file that cannot be written is named, with the reason", "[image]") {
    const Folder folder;
    const std::string path = folder / "none/a.exr";
    CHECK(test::failure(Status::file, [&] { write_image(gray({1}), path); }) ==
          path + ": cannot create: No such file or directory");
}

TEST_CASE("channels: in one piece, copied, moved, compared, and of one size", "[image][promise:pictures]") {
    Channels channels(3, std::vector<float>{1, 2});
    REQUIRE(channels.size() == 2);
    CHECK(channels[1].data() == channels[0].data() + 3);
    CHECK(std::ranges::equal(channels[0], std::vector<float>{1, 1, 1}));
    CHECK(std::ranges::equal(channels[1], std::vector<float>{2, 2, 2}));
    CHECK(channels == Channels({{1, 1, 1}, {2, 2, 2}}));
    Channels copy = channels;
    copy[1][2] = 7;
    CHECK(channels[1][2] == 2);
    CHECK(copy != channels);
    channels = copy;
    CHECK(copy == channels);
    const Channels moved = std::move(copy);
    CHECK(moved == channels);
    CHECK(copy.empty());  // NOLINT: that is what is tested
    CHECK(Channels() == Channels(std::vector<std::vector<float>>{}));
    CHECK(Channels() != Channels(0, std::vector<float>{1}));
    CHECK(Channels() == Channels(7, {}));
    const std::size_t many = 2'000'001;  // several threads fill them
    const Channels large(many, std::vector<float>{3, 4});
    CHECK(std::ranges::count(large[0], 3.0f) == many);
    CHECK(std::ranges::count(large[1], 4.0f) == many);
    CHECK(test::failure(Status::usage, [] {
              Channels({{1, 2}, {1, 2}, {1}});
          }) == "channel 2 has 1 values, channel 0 has 2");
}

TEST_CASE("a picture that is not well formed is refused", "[image]") {
    const auto refusal = [](Image image, const char* format = "exr") {
        return test::failure(Status::usage, [&] { encode(image, format, "a"); });
    };
    Image image = gray({1, 2});
    image.width = 0;
    CHECK(refusal(image) == "a: the picture has the size 0 x 1");
    image = gray({1, 2});
    image.names.pop_back();
    CHECK(refusal(image) == "a: the picture has 2 names for 3 channels");
    image = gray({1, 2});
    image.height = 3;
    CHECK(refusal(image) == "a: the picture has channels of 2 values, not 6");
    image = gray({1, 2});
    image.matrices["m"] = {1, 2};
    CHECK(refusal(image) == "a: the picture has 2 numbers in matrix m, not 16");
    image = gray({1, 2});
    image.names[1] = "Z";
    CHECK(refusal(image, "png") == "a: the picture has no channel G, which a PNG needs");
    CHECK(refusal(gray({1}), "jpg") == "a: pictures are written as exr or png, not as \"jpg\"");
    CHECK(test::failure(Status::usage, [] { write_image(gray({1}), "picture"); }) ==
          "picture: pictures are written as exr or png, not as \"\"");
}

TEST_CASE("a file that is no EXR is refused by name", "[image]") {
    const Folder folder;
    CHECK(test::failure(Status::file, [&] {
              read_image(folder / "missing.exr");
          }).starts_with((folder / "missing.exr") + ": cannot read: "));
    std::ofstream(folder / "text.exr") << "not a picture";
    CHECK(test::failure(Status::file, [&] {
              read_image(folder / "text.exr");
          }).starts_with((folder / "text.exr") + ": cannot read: "));
    write_image(gray({1}), folder / "a.png");
    CHECK(test::failure(Status::file, [&] { read_image(folder / "a.png"); }) ==
          (folder / "a.png") + ": is no EXR file");
    // Cut off in the middle.
    write_image(full_picture(), folder / "cut.exr");
    fs::resize_file(folder / "cut.exr", fs::file_size(folder / "cut.exr") - 40);
    CHECK(
        test::failure(Status::file, [&] { read_image(folder / "cut.exr"); }).starts_with((folder / "cut.exr") + ": "));
}

TEST_CASE("\"-\" is standard output", "[image]") {
    const Folder folder;
    const Image image = gray({0, 0.5f, 1});
    std::fflush(stdout);
    const int saved = dup(STDOUT_FILENO);
    REQUIRE(std::freopen((folder / "out").c_str(), "w", stdout) != nullptr);
    write_image(image, "-", "png");
    std::fflush(stdout);
    dup2(saved, STDOUT_FILENO);
    close(saved);
    write_image(image, folder / "file.png");
    CHECK(test::read_file(folder / "out") == test::read_file(folder / "file.png"));
    CHECK(!test::read_file(folder / "out").empty());
}

TEST_CASE("an EXR that is cut short, or lacks a row or an attribute, is not whole", "[image]") {
    Image image;
    image.width = 40;
    image.height = 35;
    image.names = {"R", "G", "B", "A", "Z"};
    image.channels = Channels(40 * 35, std::vector<float>(5, 0.5f));
    for (std::size_t c = 0; c < 5; ++c)
        for (std::size_t i = 0; i < 40 * 35; ++i) image.channels[c][i] = static_cast<float>(i * (c + 1) % 97) / 97;
    image.attributes["csgrt:a name of more than thirty-one letters"] = "a flag of OpenEXR's";
    image.matrices["worldToCamera"] = std::vector<float>(16, 1);
    std::vector<unsigned char> bytes = encode(image, "exr", "picture");
    REQUIRE(is_whole(bytes, image));
    for (std::size_t size = 0; size < bytes.size(); ++size)
        if (is_whole(std::span(bytes).first(size), image)) FAIL_CHECK("cut to " << size);
    Image other = image;
    other.height = 50;
    CHECK(!is_whole(bytes, other));
    other = image;
    other.attributes["csgrt:more"] = "";
    CHECK(is_whole(bytes, other));
    other.attributes["csgrt:more"] = "text";
    CHECK(!is_whole(bytes, other));
    other = image;
    other.matrices["worldToNDC"] = std::vector<float>(16, 1);
    CHECK(!is_whole(bytes, other));
    // The first block begins behind the table of three, whose first entry says where: 0 if it was never written.
    for (std::size_t at = 8; at + 32 < bytes.size(); ++at) {
        std::uint64_t begin;
        std::memcpy(&begin, &bytes[at], sizeof begin);
        if (begin != at + 24) continue;
        std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), 8, 0);
        break;
    }
    CHECK(!is_whole(bytes, image));
}

TEST_CASE("an attribute that OpenImageIO writes under another name comes back", "[image]") {
    const Folder folder;
    Image image = gray({1});
    image.attributes["ImageDescription"] = "comments, as EXR files have them";
    write_image(image, folder / "a.exr");
    CHECK(read_image(folder / "a.exr").attributes.at("ImageDescription") == image.attributes["ImageDescription"]);
}
