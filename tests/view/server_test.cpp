// What a Viewer answers is what Model and Renderer say of the same view; and who gets no answer.
#include <sys/stat.h>
#include <zlib.h>

#include <chrono>
#include <filesystem>
#include <fstream>

#include <csgrt/edit.hpp>
#include <csgrt/renderer.hpp>
#include <csgrt/scene_io.hpp>

#include "catch.hpp"
#include "cli/command.hpp"
#include "folder.hpp"
#include "page_client.hpp"
#include "thrown.hpp"

using namespace csgrt;
using namespace csgrt::test;

namespace {

/// What a line of a shell's prints; "failed" in place of it.
std::string printed_by(const std::string& line) {
    std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(line.c_str(), "r"), pclose);
    std::string text;
    for (int c = 0; (c = std::fgetc(pipe.get())) != EOF;) text += static_cast<char>(c);
    return pclose(pipe.release()) == 0 ? text : "failed";
}

constexpr int width = 96, height = 80;

void write_exr(const Image& image, const std::string& path, const std::function<bool(double)>& progress) {
    write_image(image, path, "exr", progress);
}

Model operators() { return Model(load_scene(std::getenv("CSGRT_SCENES") + std::string("/operators.json"))); }

View view_of(const json& page_view) {
    const json& camera = page_view["camera"];
    View view{.width = width, .height = height};
    view.camera = {
        .azimuth = camera["azimuth"], .elevation = camera["elevation"], .perspective = camera["perspective"]};
    const json& c = camera["center"];
    view.camera.center = Vec3{c[0], c[1], c[2]};
    view.camera.view_size = camera["view_size"];
    view.edges = page_view["edges"];
    view.light = page_view["light"] == "studio" ? Lighting::studio : Lighting::model;
    view.transparent = true;
    return view;
}

json sized(const json& view) { return {{"view", view}, {"width", width}, {"height", height}}; }

std::string display_bytes(Renderer& renderer, View view) {
    view.every_partition = false;
    view.channels = channel::display;
    const Image image = renderer.render(view);
    const auto pixels = image.ids("RGBA8");
    return {reinterpret_cast<const char*>(pixels.data()), pixels.size_bytes()};
}

std::string inflated(const std::string& packed, std::size_t size) {
    std::string bytes(size, '\0');
    uLongf length = size;
    REQUIRE(uncompress(reinterpret_cast<Bytef*>(bytes.data()), &length, reinterpret_cast<const Bytef*>(packed.data()),
                       packed.size()) == Z_OK);
    for (std::size_t i = 4; i < bytes.size(); ++i) bytes[i] = static_cast<char>(bytes[i] + bytes[i - 4]);
    return bytes;
}

}  // namespace

TEST_CASE("view: a frame has the bytes of the Renderer's picture, packed or not", "[view]") {
    const Model model = operators();
    const PageClient page(model);
    Renderer renderer(model);
    json view = page.ask("model")["view"];
    CHECK(page.frame(sized(view)).pixels == display_bytes(renderer, view_of(view)));

    json request = sized(view);
    request["encoding"] = "deflate";
    CHECK(inflated(page.frame(request).pixels, 4 * width * height) == display_bytes(renderer, view_of(view)));

    const std::string text = page.post("model", json::object())->body;
    const std::string packed = page.post("model", {{"encoding", "deflate"}})->body;
    std::string unpacked(text.size(), '\0');
    uLongf length = unpacked.size();
    CHECK(uncompress(reinterpret_cast<Bytef*>(unpacked.data()), &length, reinterpret_cast<const Bytef*>(packed.data()),
                     packed.size()) == Z_OK);
    CHECK((unpacked == text && packed.size() < text.size() / 2));

    request["samples"] = 16;
    request["encoding"] = "raw";
    View sampled = view_of(view);
    sampled.samples = 16;
    CHECK(page.frame(request).pixels == display_bytes(renderer, sampled));

    view["clip"] = {{{"normal", {1, 0, 0}}, {"distance", 100}}};
    view["camera"]["perspective"] = 40;
    View cut = view_of(view);
    cut.clip = {{{1, 0, 0}, 100}};
    CHECK(page.frame(sized(view)).pixels == display_bytes(renderer, cut));

    view["looks"] = {{{"path", "/operators/union"}, {"state", "hidden"}},
                     {{"path", "/operators"}, {"color", {0, 0.5, 1}}},
                     {{"path", "/no/such/region"}, {"state", "hidden"}}};
    renderer.set_model(
        Edit(model).set_state("/operators/union", State::hidden).set_color("/operators", {0, 0.5, 1}).commit());
    CHECK(page.frame(sized(view)).pixels == display_bytes(renderer, cut));

    view["looks"] = {{{"path", "/"}, {"state", "hidden"}}, {{"path", "/operators/union"}, {"state", "shown"}}};
    renderer.set_model(
        Edit(model).set_state("/operators", State::hidden).set_state("/operators/union", State::shown).commit());
    CHECK(page.frame(sized(view)).pixels == display_bytes(renderer, cut));
    CHECK_THAT(page.ask("command", sized(view))["command"].get<std::string>(),
               ContainsSubstring("--hide / --show /operators/union"));
}

TEST_CASE("view: a scene's camera by its eye is shown from there", "[view]") {
    Scene scene = load_scene(std::getenv("CSGRT_SCENES") + std::string("/operators.json"));
    for (const double perspective : {0.0, 35.0}) {
        scene.camera = {.perspective = perspective};
        scene.camera.eye = Vec3{9000, -7000, 6000};
        scene.camera.look_at = Vec3{100, 200, 50};
        const Model model(scene);
        const PageClient page(model);
        const json own = page.ask("model")["view"];
        View view = view_of(own);
        view.camera = scene.camera;
        Renderer renderer(model);
        const std::string wanted = display_bytes(renderer, view), shown = page.frame(sized(own)).pixels;
        std::size_t different = 0;
        for (std::size_t i = 0; i < wanted.size(); i += 4) different += wanted.compare(i, 4, shown, i, 4) != 0;
        CAPTURE(perspective);
        CHECK(different < wanted.size() / 4 / 100);  // the angles are rounded
    }
}

TEST_CASE("view: a pick tells what Model::pick does, and the command that repeats it", "[view][promise:page]") {
    const Model model = operators();
    const std::string scene = std::getenv("CSGRT_SCENES") + std::string("/operators.json");
    const PageClient page(model, {.command = scene});
    json request = sized(page.ask("model")["view"]);
    json hit;
    int hits = 0;
    for (int y = 4; y < height; y += 9)
        for (int x = 4; x < width; x += 9) {
            request["x"] = x;
            request["y"] = y;
            const json answer = page.ask("pick", request);
            const Pick pick = model.pick(view_of(request["view"]), x, y);
            REQUIRE(answer["partitions"].size() == pick.along.partitions.size());
            for (std::size_t i = 0; i < pick.along.partitions.size(); ++i) {
                const Partition& part = pick.along.partitions[i];
                const json& row = answer["partitions"][i];
                CHECK(row["region"] == part.region);
                CHECK(row["in"] == part.in);
                CHECK(row["out"] == part.out);
                CHECK(row["in_solid"]["type"] == model.solids()[part.in_solid].type);
            }
            if (pick.region < 0) {
                CHECK(answer["region"].is_null());
                continue;
            }
            CHECK(answer["region"] == pick.region);
            CHECK(answer["point"] == json{pick.point.x, pick.point.y, pick.point.z});
            CHECK(answer["solid"]["name"] == model.solids()[static_cast<std::size_t>(pick.solid)].name);
            if (hits++ > 0) continue;
            hit = request;
            std::string line = answer["shoot"];  // with this csgrt in place of the one on the path
            line.replace(line.find("csgrt"), 5, command_test::command());
            CHECK_THAT(printed_by(line),
                       Catch::Matchers::Contains("ray 0 " + std::to_string(pick.along.partitions.size())));
        }
    CHECK(hits > 10);

    request = hit;
    const json before = page.ask("pick", request);
    REQUIRE(before["partitions"].size() > 0);
    request["view"]["looks"] = {{{"path", "/operators"}, {"state", "hidden"}}};
    request["view"]["clip"] = {{{"normal", {1, 0, 0}}, {"distance", -1e6}}};
    const json after = page.ask("pick", request);
    CHECK(after["region"].is_null());
    CHECK(after["partitions"] == before["partitions"]);

    Scene open;  // all below z = 0, seen from below
    open.objects = {Object(Solid{"under", Half{{{0, 0, 1}, 0}}})};
    const PageClient below(Model(open, {"under"}));
    request = sized(below.ask("model")["view"]);
    request["view"]["camera"] = {
        {"azimuth", 0}, {"elevation", -40}, {"perspective", 60}, {"center", {0, 0, -900}}, {"view_size", 10}};
    request.update({{"x", width / 2}, {"y", 1}});
    const json inside = below.ask("pick", request);
    CAPTURE(inside.dump());
    CHECK(inside["region"] == 0);
    CHECK((inside["normal"].is_null() && inside["thickness"].is_null()));
}

TEST_CASE("view: the command draws the page's picture", "[view][promise:page]") {
    const std::string scene = std::getenv("CSGRT_SCENES") + std::string("/operators.json");
    const Precision precision = GENERATE(Precision::double_, Precision::single);
    const Settings settings{.reference = precision == Precision::single, .precision = precision};
    const PageClient page(operators(), {.command = scene}, settings);
    json view = page.ask("model")["view"];
    view["camera"]["azimuth"] = 71.25;
    view["clip"] = {{{"normal", {0, 0.6, 0.8}}, {"distance", 512.5}}};
    view["looks"] = {{{"path", "/operators"}, {"state", "hidden"}},
                     {{"path", "/operators/plinth@2"}, {"state", "shown"}},
                     {{"path", "/operators/difference"}, {"state", "shown"}, {"color", {0.25, 0.5, 1}}}};
    Folder folder;
    json request = sized(view);
    request["samples"] = 4;
    std::string line = page.ask("command", request)["command"];
    line.replace(0, 5, command_test::command());
    line.replace(line.find("view.png"), 8, folder / "view.exr");
    CHECK((line.find(" --precision single ") != line.npos) == settings.reference);
    if (settings.reference) line += " --reference";  // the native device draws in double precision
    REQUIRE(printed_by(line) == "");
    const auto pixels = display_pixels(read_image(folder / "view.exr"));
    CHECK(page.frame(request).pixels == std::string(pixels.begin(), pixels.end()));
}

/// Slanting bars, of which a picture of 403x299 pixels shows one or two pixels across.
Model thin_bars() {
    Scene scene;
    for (int i = 0; i < 40; ++i) {
        Arb bar;
        for (std::size_t k = 0; k < 8; ++k) {
            const double y = k / 2 % 2 ? 100 : -100, side = k % 4 == 1 || k % 4 == 2 ? 2 : -2;
            bar.vertices[k] = {k < 4 ? -1.0 : 1.0, y, 10.0 * i + 0.2 * y + side};
        }
        scene.top.push_back("bar" + std::to_string(i));
        scene.objects.push_back(Solid{scene.top.back(), bar, {}});
    }
    return Model(scene);
}

TEST_CASE("view: a slice and an EXR are those of Model and Renderer", "[view]") {
    const Model model = GENERATE(0, 1) ? operators() : thin_bars();
    const PageClient page(model, {.write_exr = write_exr});
    json request = sized(page.ask("model")["view"]);
    request.update({{"center", {0, 0, 10}}, {"right", {100, 0, 0}}, {"up", {0, 100, 0}}});
    Array<std::int32_t> ids;
    model.slice({{0, 0, 10}, {100, 0, 0}, {0, 100, 0}, width, height, false}, ids);
    const auto sliced = page.post("slice", request);
    CHECK(sliced->body == std::string(reinterpret_cast<const char*>(ids.data()), ids.size() * 4));

    Folder folder;
    request.update({{"width", 403}, {"height", 299}});  // several passes
    std::ofstream(folder / "a.exr", std::ios::binary) << page.post("exr", request)->body;
    const Image read = read_image(folder / "a.exr");
    Renderer renderer(model);
    View view = view_of(request["view"]);
    view.width = 403;
    view.height = 299;
    const Image whole = renderer.render(view);
    CHECK((read.channels == whole.channels && read.matrices == whole.matrices));
}

TEST_CASE("view: a picture that takes several passes is that of one, ghosts included", "[view][promise:page]") {
    const Model model = operators();
    const PageClient page(model);
    json view = page.ask("model")["view"];
    view["looks"] = {{{"path", "/operators/union"}, {"state", "ghost"}}};
    json request = {{"view", view}, {"width", 651}, {"height", 403}};
    const std::string middles = page.frame(request).pixels;
    request["samples"] = 64;  // seventeen million rays
    const std::string means = page.frame(request).pixels;
    REQUIRE(means.size() == middles.size());
    View wanted = view_of(view);
    wanted.width = 651;
    wanted.height = 403;
    wanted.samples = 64;
    Renderer renderer(Edit(model).set_state("/operators/union", State::ghost).commit());
    const std::string without = display_bytes(renderer, wanted);
    wanted.samples = 1;
    const std::string without_of_middles = display_bytes(renderer, wanted);
    std::size_t lines = 0, wrong = 0;
    for (std::size_t i = 0; i < means.size(); i += 4) {  // the outline's pixels are the same
        const bool is_line = middles.compare(i, 4, without_of_middles, i, 4) != 0;
        lines += is_line;
        wrong += means.compare(i, 4, is_line ? middles : without, i, 4) != 0;
    }
    CHECK(lines > 100);
    CHECK(wrong < lines / 10);  // an outline may have the colour of what is behind it
}

TEST_CASE("view: parts are told as they are asked for", "[view]") {
    const Model model = operators();
    const PageClient page(model);
    const json whole = page.ask("model");
    REQUIRE(whole["paths"].size() == model.regions().size());
    for (std::size_t i = 0; i < model.regions().size(); ++i) {
        const RegionInfo& region = model.regions()[i];
        const json& look = whole["own_looks"][whole["look_of"][i].get<std::size_t>()];
        CHECK(whole["paths"][i] == region.path);
        CHECK(look == json{{"state", "shown"}, {"color", {region.color.x, region.color.y, region.color.z}}});
    }
    const auto told = [&](const json& ranges, int generation = 1) {
        return page.ask("parts", {{"generation", generation}, {"parts", {{{"regions", ranges}}}}});
    };
    const json row = told({{2, 3}, {5, 6}})["rows"][0];
    const RegionInfo &first = model.regions()[2], &second = model.regions()[5];
    CHECK(row["region_id"] == first.region_id);
    CHECK(row["material_id"] == first.material_id);
    CHECK(row["low"][1] == std::min(first.bounds.low.y, second.bounds.low.y));
    CHECK(row["high"][2] == std::max(first.bounds.high.z, second.bounds.high.z));
    CHECK(told(json::array())["rows"] == json{nullptr});
    CHECK(told({{0, 1}}, 2)["error"] == "the model has changed: ask again");
    for (const json& wrong :
         {json{{0, 1'000'000}}, json{{2, 3}, {0, 1}}, json{{1, 1}}, json{{-1, 1}}, json{{1}}, json{1}, json(7)})
        CHECK_THAT(told(wrong)["error"].get<std::string>(), ContainsSubstring("parts[0].regions: expected"));
}

TEST_CASE("view: what is no colour is shown, too, and a ghost has an outline", "[view][promise:page]") {
    const Model model = Model(load_scene(std::getenv("CSGRT_SCENES") + std::string("/overlap.json")));
    const PageClient page(model);
    json view = page.ask("model")["view"];
    const std::string colors = page.frame(sized(view)).pixels;
    std::vector<std::string> seen = {colors};
    for (const char* show : {"depth", "normal", "region", "overlap", "segments", "marks"}) {
        view["show"] = show;
        seen.push_back(page.frame(sized(view)).pixels);
        CHECK(seen.back().size() == colors.size());
    }
    for (std::size_t i = 0; i < seen.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) CHECK(seen[i] != seen[j]);
    CHECK(seen[4].find("\xcc\x0d\x0d\xff"[0]) != std::string::npos);  // red: pixels that are claimed twice

    view["show"] = "color";
    view["looks"] = {{{"path", "/overlap/left.r"}, {"state", "hidden"}}};
    const std::string hidden = page.frame(sized(view)).pixels;
    view["looks"][0]["state"] = "ghost";
    const std::string ghost = page.frame(sized(view)).pixels;
    std::size_t lines = 0;
    for (std::size_t i = 0; i < hidden.size(); i += 4) lines += hidden.compare(i, 4, ghost, i, 4) != 0;
    CHECK(lines > 20);
    CHECK(lines < hidden.size() / 4 / 4);
}

TEST_CASE("view: the newest frame of a page ends those before it, another page's does not", "[view]") {
    const PageClient page(operators());
    json slow = {{"view", page.ask("model")["view"]}, {"width", 4096}, {"height", 4096}, {"samples", 64}};
    FrameAnswer first;
    std::thread drawing([&] { first = page.frame(slow); });
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    json quick = sized(slow["view"]);
    quick["number"] = 2;
    CHECK(page.frame(quick).pixels.size() == 4 * width * height);
    drawing.join();
    CHECK(first.head == json{{"cancelled", true}});
    CHECK(page.frame(sized(slow["view"])).head == json{{"cancelled", true}});  // number 1 is old
    quick["page"] = "other";
    quick["number"] = 1;
    CHECK(page.frame(quick).pixels.size() == 4 * width * height);
}

TEST_CASE("view: a page that refines its picture keeps no other page waiting", "[view][promise:page]") {
    auto page = std::make_unique<PageClient>(operators());
    const json view = page->ask("model")["view"];
    std::thread refining([&client = *page, &view] {
        client.frame({{"view", view}, {"width", 2048}, {"height", 2048}, {"samples", 256}, {"page", "refines"}});
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    for (int number = 1; number < 4; ++number) {
        const json quick = {{"view", view},    {"width", 64},      {"height", 64},     {"samples", 1},
                            {"page", "other"}, {"number", number}, {"encoding", "raw"}};
        CHECK(page->connect(10'000).ask("POST", page->root() + "api/frame", quick.dump()));  // refining takes minutes
    }
    page->ask("end");
    refining.join();
}

TEST_CASE("view: a check lists overlaps, each with a link and a ray", "[view][promise:page]") {
    const PageClient page(Model(load_scene(std::getenv("CSGRT_SCENES") + std::string("/overlap.json"))));
    const json made = json::parse(page.post("check", {{"min_depth", 0.1}})->body);
    CHECK((made["new_overlaps"] == 2 && made["candidates"] == 2));
    REQUIRE(made["overlaps"].size() == 2);
    const json& blocks = made["overlaps"][0];
    CHECK((blocks["depth"] > 14.9 && blocks["depth"] < 15.1 && blocks["is_new"] == true));
    CHECK(blocks["link"].get<std::string>().starts_with("#%7B%22camera%22"));
    CHECK(blocks["shoot"].get<std::string>().starts_with("printf '"));
    CHECK(page.post("check", {{"min_depth", 0}})->body.find("greater than 0 mm") != std::string::npos);
}

TEST_CASE("view: pages that refine their pictures or export them take turns", "[view][promise:page]") {
    auto page = std::make_unique<PageClient>(operators(), ViewerOptions{.write_exr = write_exr});
    const json view = page->ask("model")["view"];
    std::thread refining([&client = *page, &view] {
        client.frame({{"view", view}, {"width", 2048}, {"height", 2048}, {"samples", 256}, {"page", "refines"}});
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    const json other = {{"view", view},          {"width", 400}, {"height", 400},    {"samples", 16},
                        {"page", "refines too"}, {"number", 1},  {"encoding", "raw"}};
    for (const char* name : {"frame", "exr"}) {
        const auto answer = page->connect(20'000).ask("POST", page->root() + "api/" + name, other.dump());
        REQUIRE(answer);  // the first page's picture takes minutes
        CHECK(answer->body.size() > 4 * 400 * 400);
    }
    page->ask("end");
    refining.join();
}

TEST_CASE("view: the frame of a client that is gone ends", "[view]") {
    const PageClient page(operators());
    const json slow = {{"view", page.ask("model")["view"]},
                       {"width", 4096},
                       {"height", 4096},
                       {"samples", 256},
                       {"page", "gone"},
                       {"number", 1},
                       {"encoding", "raw"}};
    const auto start = std::chrono::steady_clock::now();
    CHECK(!page.connect(300).ask("POST", page.root() + "api/frame", slow.dump()));  // and closes the connection
    CHECK(page.frame(sized(slow["view"])).pixels.size() == 4 * width * height);
    CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(20));  // the frame takes minutes
}

TEST_CASE("view: run ends while a frame is drawn, and at the button", "[view][promise:page]") {
    auto page = std::make_unique<PageClient>(operators());
    const json slow = {{"view", page->ask("model")["view"]}, {"width", 4096}, {"height", 4096}, {"samples", 256}};
    json answer;
    std::thread drawing([&answer, &slow, &client = *page] { answer = client.frame(slow).head; });
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    const auto start = std::chrono::steady_clock::now();
    CHECK(page->ask("end") == json::object());
    drawing.join();
    CHECK(answer == json{{"cancelled", true}});
    page.reset();
    CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(20));  // the frame takes minutes
}

TEST_CASE("view: a changed file is seen, and one that does not load leaves the old model", "[view][promise:page]") {
    Folder folder;
    const std::string file = folder / "scene.json";
    std::filesystem::copy_file(std::getenv("CSGRT_SCENES") + std::string("/operators.json"), file);
    const PageClient page(Model(load_scene(file)), {.file = file, .load = [&] { return Model(load_scene(file)); }});
    const auto until = [&](auto&& is_done) {
        for (int i = 0; i < 300 && !is_done(page.ask("status")); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        return is_done(page.ask("status"));
    };
    const json view = page.ask("model")["view"];
    const std::string before = page.frame(sized(view)).pixels;
    std::ofstream(file) << "{\"csgrt\": 1, \"solids\": {\"a\": {\"type\": \"spere\"}}}";
    CHECK(until([](const json& status) { return status["error"].is_string(); }));
    CHECK(page.ask("status")["error"].get<std::string>().find("spere") != std::string::npos);
    CHECK(page.frame(sized(view)).pixels == before);
    std::filesystem::copy_file(std::getenv("CSGRT_SCENES") + std::string("/overlap.json"), file,
                               std::filesystem::copy_options::overwrite_existing);
    CHECK(until([](const json& status) { return status["generation"] == 2 && status["error"].is_null(); }));
    CHECK(page.ask("model")["paths"][0].get<std::string>().starts_with("/overlap"));

    const auto says = [&](const std::string& what) {
        return until([&](const json& status) {
            return status["error"].is_string() && status["error"].get<std::string>().find(what) != std::string::npos;
        });
    };
    const std::string other = folder / "other.json";
    const auto back_again = [&](int generation) {
        std::filesystem::remove(file);
        std::filesystem::copy_file(std::getenv("CSGRT_SCENES") + std::string("/overlap.json"), file);
        return until(
            [&](const json& status) { return status["generation"] == generation && status["error"].is_null(); });
    };
    std::filesystem::remove(file);
    CHECK(says("is not there any more"));
    CHECK(back_again(3));
    std::filesystem::remove(file);
    REQUIRE(mkfifo(file.c_str(), 0600) == 0);
    CHECK(says("but a pipe"));
    CHECK(back_again(4));
    std::filesystem::remove(file);
    std::filesystem::create_directory(file);
    CHECK(says("but a folder"));
    std::filesystem::remove(file);
    std::filesystem::create_symlink("/dev/zero", file);
    CHECK(says("but a device"));
    std::filesystem::remove(file);
    std::filesystem::create_symlink("nowhere", file);
    CHECK(says("is not there any more"));
    CHECK(page.frame(sized(view)).pixels.size() == 4 * width * height);
    CHECK(back_again(5));

    // Another file of the same size and time.
    std::filesystem::copy_file(file, other);
    std::filesystem::last_write_time(other, std::filesystem::last_write_time(file));
    std::filesystem::rename(other, file);
    CHECK(until([](const json& status) { return status["generation"] == 6; }));
}

TEST_CASE("view: wrong requests are refused with a sentence that names the member", "[view]") {
    const PageClient page(operators());
    const json right = sized(page.ask("model")["view"]);
    const auto refused = [&](const char* name, json request, const char* pointer, const json& value) {
        request[json::json_pointer(pointer)] = value;
        const auto result = page.post(name, request);
        CHECK(result->status == 400);
        return json::parse(result->body)["error"].get<std::string>();
    };
    using Catch::Matchers::Contains;
    CHECK_THAT(refused("pick", right, "/x", 96), Contains("x: expected a whole number from 0 to 95"));
    CHECK_THAT(refused("pick", right, "/x", 0), Contains("y: is missing"));
    CHECK_THAT(refused("command", right, "/width", 0), Contains("width: expected"));
    CHECK_THAT(refused("command", right, "/view/camera/azimuth", "35"), Contains("view.camera.azimuth: expected a n"));
    CHECK_THAT(refused("command", right, "/view/show", "colour"), Contains("show: there is no 'colour'"));
    CHECK_THAT(refused("command", right, "/view/light", "sun"), Contains("light: there is no 'sun'"));
    CHECK_THAT(refused("command", right, "/view/looks", {{{"path", 1}}}), Contains("view.looks[0].path: expected"));
    CHECK_THAT(refused("command", right, "/view", 1), Contains("view: expected an object"));
    const auto status = [&](const std::string& body) {
        return page.connect().ask("POST", page.root() + "api/model", body)->status;
    };
    CHECK(status("{") == 400);
    CHECK(status(std::string(1'000'000, ' ')) == 400);
    CHECK(status(std::string(1'000'001, ' ')) == 413);
    json request = right;
    request["view"]["camera"]["perspective"] = 180;
    request.update({{"page", "a"}, {"number", 1}, {"samples", 1}, {"encoding", "raw"}});
    CHECK_THAT(page.frame(request).head["error"].get<std::string>(), Contains("perspective"));
}

TEST_CASE("view: nobody else gets in", "[view][promise:page]") {
    const PageClient page(operators());
    const std::string port = page.host().substr(page.host().rfind(':'));
    const auto status = [&](const std::string& path, const Headers& headers) {
        return page.connect().ask("POST", path, "{}", headers)->status;
    };
    const std::string model = page.root() + "api/model";
    CHECK(status(model, {}) == 200);
    CHECK(status(model, {{"Host", "localhost:9000"}, {"Origin", "http://localhost:9000"}}) == 200);  // a tunnel
    CHECK(status(model, {{"Host", "[::1]:9000"}}) == 200);
    for (const char* host : {"evil.example", "evil.example:80", "127.0.0.1.evil.example", "10.0.0.1", "127.0.0.1:x",
                             "[::1", "localhost.", ""})
        CHECK(status(model, {{"Host", host}}) == 403);
    for (const std::string& origin : {std::string("http://evil.example"), std::string("null"),
                                      "https://127.0.0.1" + port, std::string("http://127.0.0.1:1")})
        CHECK(status(model, {{"Host", "127.0.0.1" + port}, {"Origin", origin}}) == 403);
    CHECK(status("/api/model", {}) == 404);
    CHECK(status("/" + std::string(32, '0') + "/api/model", {}) == 404);
    CHECK(status(page.root() + "api/none", {}) == 404);
    CHECK(status(page.root() + "../../etc/passwd", {}) == 404);
    CHECK(status(model, {{"Content-Type", "text/plain"}}) == 415);
    const auto get = [&](const std::string& path) { return *page.connect().ask("GET", path); };
    CHECK(get(model).status == 405);
    CHECK(get("/").status == 404);
    const std::string root = page.root();
    for (const std::string& path : {root.substr(0, root.size() - 1), "/" + std::string(32, '0') + "/"}) {
        const auto said = get(path);
        CHECK(said.headers.at("content-type").starts_with("text/html"));
        CHECK_THAT(said.body, ContainsSubstring("with the slash at its end") && !ContainsSubstring("{"));
    }
    CHECK(get(page.root()).body.find("<html") != std::string::npos);
    CHECK(get(page.root()).headers["content-security-policy"].starts_with("default-src 'none'"));

    const auto second = [&] { Viewer(operators(), {}, {.port = page.port()}); };  // two Viewers have one port
    CHECK_THAT(csgrt::test::failure(Status::file, second), ContainsSubstring("another program"));
}
