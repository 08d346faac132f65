// What else a host notices of csgrt: its threads, signals, locale, and how a process ends.
#include <algorithm>
#include <atomic>
#include <clocale>
#include <functional>
#include <future>
#include <locale>
#include <optional>
#include <thread>

#include <dlfcn.h>
#include <pthread.h>

#include "cli/command.hpp"
#include "device/discovery.hpp"
#include "host/process.hpp"
#include "integration/same_answers.hpp"

using namespace csgrt;
using namespace csgrt::test;

namespace {

constexpr std::size_t stack_bytes = 256 << 10;  // of a thread that calls csgrt
constexpr const char* pocl = "Portable Computing Language";

/// By their numbers; of signal 0 there is none.
std::vector<struct sigaction> handlers() {
    std::vector<struct sigaction> all(static_cast<std::size_t>(SIGRTMAX) + 1);
    for (int signal = 1; signal <= SIGRTMAX; ++signal)
        sigaction(signal, nullptr, &all[static_cast<std::size_t>(signal)]);
    return all;
}

/// Makes a locale of the system's sources in `folder`, and takes it. False where the machine has none.
bool take_locale(const std::string& folder, const std::string& name, const std::string& characters) {
    const std::string target = folder + "/" + name + "." + characters;
    const std::string make = "localedef -i " + name + " -f " + characters + " " + target + " 2> /dev/null";
    static_cast<void>(std::system(make.c_str()));  // its warnings count as failures, too
    setenv("LOCPATH", folder.c_str(), 1);
    return std::setlocale(LC_ALL, (name + "." + characters).c_str()) != nullptr;
}

/// A host's own locale of C++: 1.234.567,8.
struct Commas : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
};

/// What csgrt writes of what it reads, and numbers in what it says.
std::string texts(const std::string& folder) {
    std::string all;
    for (const std::string& file : scene_files()) {
        save_scene(load_scene(file), folder + "/scene.json");
        all += test::read_file(folder + "/scene.json");
    }
    const auto say = [&](const auto& call) {
        try {
            call();
        } catch (const Error& error) {
            all += error.what();
        }
    };
    const std::string turn = R"({"csgrt": 1, "solids": {"turn": {"type": "revolve", "base": [0, 0, 0],
        "axis": [0, 0, 1], "r": [1, 0, 0], "angle": 1.5e-12, "sketch": {"vertices": [[1.5, 0], [2.5, 0], [2.5, 1]],
        "curves": [{"line": [0, 1]}, {"line": [1, 2]}, {"line": [2, 0]}]}}},
        "combinations": {"part": {"region": true, "tree": "turn"}}})";
    const Renderer turned(parse_scene(turn, "turn.json"), {}, on("reference"));
    for (const Warning& warning : turned.model().warnings()) all += format(warning);
    say([&] { parse_scene(R"({"csgrt": 1.5, "solids": {"a": 1,5}})", "wrong.json"); });
    const Scene scene = small_scene();
    Settings settings = on("NATIVE");  // ı is no small I
    settings.max_memory = 2000;
    say([&] { Renderer(scene, {}, settings).render({.width = 64, .height = 64}); });
    const Image image = Renderer(scene, {}, on("reference")).render(small_view());
    for (const auto& [key, value] : image.attributes) all += key + value;
    return all;
}

void require_same_texts(const std::string& folder, const std::string& usual) {
    const std::string mine = texts(folder);
    const auto [a, b] = std::mismatch(mine.begin(), mine.end(), usual.begin(), usual.end());
    INFO("here: " << std::string(a, std::min(a + 200, mine.end())));
    REQUIRE(mine == usual);
}

/// Destroyed after all that main() begins.
std::optional<Renderer> kept;
std::optional<Framebuffer> kept_picture;

Renderer drawn_by_pocl() {
    Renderer renderer = renderer_on(small_scene(), on("pocl"));
    renderer.render(small_view());
    return renderer;
}

/// Ends while its thread draws.
struct Worker {
    std::atomic<bool> stop{false};
    std::string why = {};
    std::thread thread{[this] {
        try {
            while (!stop) kept->render(small_view());
        } catch (const Error& error) {
            why = error.what();
        }
    }};
    ~Worker() {
        usleep(300'000);
        stop = true;
        thread.join();
        if (!command_test::contains(why, "after exit()")) _exit(1);
    }
};

/// Draws when the process ends.
struct Late {
    ~Late() {
        try {
            kept->render(small_view());
            _exit(1);
        } catch (const Error& error) {
            if (!command_test::contains(error.what(), "after exit()")) _exit(1);
        }
    }
};

/// Ends the process as a program that returns 7 from main() while `work` goes on in another thread.
template <class Work>
void end_while(unsigned microseconds, const Work& work) {
    std::thread(work).detach();
    usleep(microseconds);
    std::exit(7);
}

}  // namespace

TEST_CASE("csgrt's threads leave all signals to the host's, and so do a driver's that csgrt starts",
          "[device][promise:process]") {
    for (const std::string who : {"native", "reference", "pocl"})
        require_good(who, [&] {
            Settings settings = on(who);
            std::size_t most = 0;
            settings.progress = [&](double) {
                most = std::max(most, require_silent_threads());
                return true;
            };
            const Scene scene = small_scene();
            Renderer renderer = renderer_on(scene, settings);
            renderer.render({.width = 1024, .height = 1024, .every_partition = false});  // longer than Watch::period
            most = std::max(most, require_silent_threads());
            REQUIRE(most >= (who == "pocl" ? 1 : 2));
        });
    require_good("a search for devices", [] {
        const PretendedGpu gpu(pocl);
        prepare_devices();
        for (int i = 0; i < 20; ++i) {
            require_silent_threads();
            usleep(2000);
        }
    });
}

TEST_CASE("a Renderer that may use one thread starts none", "[device][promise:process]") {
    for (const std::string who : {"native", "reference"})
        require_good(who, [&] {
            Settings settings = on(who);
            settings.threads = 1;
            Renderer renderer = renderer_on(small_scene(), settings);
            renderer.render({.width = 256, .height = 256});
            REQUIRE(require_silent_threads() == 0);
            settings.threads = 2;
            renderer_on(small_scene(), settings).render({.width = 256, .height = 256});
            REQUIRE(require_silent_threads() == 1);
        });
}

TEST_CASE("csgrt changes no handler of a signal, and no thread's signals", "[device][promise:process]") {
    for (const std::string who : {"native", "reference"})
        require_good(who, [&] {
            const std::vector<struct sigaction> before = handlers();
            sigset_t blocked_before, blocked_after;
            pthread_sigmask(SIG_SETMASK, nullptr, &blocked_before);
            renderer_on(small_scene(), on(who)).render(small_view());
            const std::vector<struct sigaction> after = handlers();
            pthread_sigmask(SIG_SETMASK, nullptr, &blocked_after);
            for (int signal = 1; signal < SIGRTMAX; ++signal) {
                INFO("signal " << signal);
                const auto i = static_cast<std::size_t>(signal);
                REQUIRE(before[i].sa_handler == after[i].sa_handler);
                REQUIRE(before[i].sa_flags == after[i].sa_flags);
                REQUIRE(sigismember(&blocked_before, signal) == sigismember(&blocked_after, signal));
            }
        });
}

TEST_CASE("a host's handlers get their signals after PoCL's compiler has put its own before them",
          "[device][promise:process]") {
    for (const int signal : {SIGHUP, SIGINT, SIGTERM, SIGUSR2})
        require_good("pocl", [signal] {
            static volatile std::sig_atomic_t got = 0;
            std::signal(signal, [](int number) { got = number; });
            renderer_on(small_scene(), on("pocl")).render(small_view());
            std::raise(signal);
            REQUIRE(got == signal);
        });
}

TEST_CASE("a Renderer may go from thread to thread, and needs little of their stacks", "[device][promise:process]") {
    for (const std::string who : {"native", "reference"})
        require_good(who, [&] {
            struct Call {
                std::string who;
                std::optional<Renderer> renderer;
                Image image;
                bool missing = false;
            } call{who, {}, {}, false};
            // Made in one thread, used by another, gone in a third.
            void* (*const steps[])(void*) = {
                [](void* given) -> void* {
                    Call& c = *static_cast<Call*>(given);
                    try {
                        c.renderer.emplace(renderer_on(small_scene(), on(c.who)));
                    } catch (const Skip&) {
                        c.missing = true;
                    }
                    return nullptr;
                },
                [](void* given) -> void* {
                    Call& c = *static_cast<Call*>(given);
                    if (c.renderer) c.image = c.renderer->render({.width = 128, .height = 128});
                    if (c.renderer) c.renderer->shoot(c.renderer->model().grid_of(small_view()).rays());
                    return nullptr;
                },
                [](void* given) -> void* {
                    static_cast<Call*>(given)->renderer.reset();
                    return nullptr;
                }};
            for (const auto step : steps) {
                pthread_attr_t small;
                pthread_attr_init(&small);
                REQUIRE(pthread_attr_setstacksize(&small, stack_bytes) == 0);
                pthread_t thread;
                REQUIRE(pthread_create(&thread, &small, step, &call) == 0);
                REQUIRE(pthread_join(thread, nullptr) == 0);
            }
            if (call.missing) throw Skip();
            require_same(call.image,
                         Renderer(small_scene(), {}, on("reference")).render({.width = 128, .height = 128}));
        });
}

TEST_CASE("a host's locale changes nothing in what is read or written", "[device][promise:process]") {
    require_good("C++", [] {
        const command_test::Folder folder;
        const std::string usual = texts(folder / "");
        std::locale::global(std::locale(std::locale(), new Commas));
        require_same_texts(folder / "", usual);
    });
    for (const auto& [name, characters] :
         {std::pair("de_DE", "UTF-8"), std::pair("tr_TR", "ISO-8859-9"), std::pair("ps_AF", "UTF-8")})
        require_good(name, [&, name = name, characters = characters] {
            const command_test::Folder folder;
            const std::string usual = texts(folder / "");
            if (!take_locale(folder / "", name, characters)) throw Skip();
            require_same_texts(folder / "", usual);
            std::locale::global(std::locale(""));
            require_same_texts(folder / "", usual);
        });
}

TEST_CASE("a process ends with its own status while another thread computes", "[device][promise:process]") {
    for (const std::string who : {"native", "reference", "pocl"}) {
        const int times = who == "pocl" ? 8 : 20;
        for (int i = 0; i < times; ++i) {
            INFO(who << ", " << i);
            const int status = status_of([&] {
                const Scene scene = small_scene();
                static_cast<void>(renderer_on(scene, on(who)));
                end_while(static_cast<unsigned>(i) * (who == "pocl" ? 40'001 : 3001), [&] {
                    for (;;) {
                        View view = small_view();
                        view.every_partition = who != "pocl";
                        Renderer renderer(scene, {}, on(who));
                        renderer.render(view);
                    }
                });
            });
            if (status == skipped) break;
            REQUIRE(status == 7);
        }
    }
    for (int i = 0; i < 20; ++i)
        REQUIRE(status_of([&] {
                    const PretendedGpu gpu(pocl);
                    prepare_devices();
                    usleep(static_cast<useconds_t>(2000 * i));
                    std::exit(7);
                }) == 7);
}

TEST_CASE("a process ends with its own status where what draws with PoCL is destroyed by exit() or unloaded",
          "[promise:process]") {
    const auto on_thread = [](const auto& work) { std::async(std::launch::async, work).get(); };
    const auto keep = [] { kept.emplace(drawn_by_pocl()); };
    const auto unload = [] {
        const char* const name = std::getenv("CSGRT_HOST_PLUGIN");
        if (name == nullptr) throw Skip();
        void* const library = dlopen(name, RTLD_NOW | RTLD_LOCAL);
        REQUIRE(library != nullptr);
        const auto draw = reinterpret_cast<int (*)(const char*)>(dlsym(library, "draw"));
        const int status = draw((test::folder("CSGRT_SCENES") + "/operators.json").c_str());
        if (status == static_cast<int>(Status::no_device)) throw Skip();
        REQUIRE(status == 0);
        REQUIRE(dlclose(library) == 0);
    };
    const std::pair<const char*, std::function<void()>> hosts[] = {
        {"global", keep},
        {"static", [] { static Renderer renderer = drawn_by_pocl(); }},
        {"global, of another thread", [&] { on_thread(keep); }},
        {"static, of another thread",
         [&] {
             on_thread([] {
                 static Renderer renderer = drawn_by_pocl();
                 renderer.render({.width = 16, .height = 16, .every_partition = false, .channels = channel::ids});
             });
         }},
        {"exit() in another thread",
         [&] {
             keep();
             on_thread([] { std::exit(7); });
         }},
        {"a GPU whose kernels are compiled",
         [] {
             const PretendedGpu gpu(pocl);
             static Renderer renderer(small_scene());
             static_cast<void>(renderer.render(small_view()));
         }},
        {"a picture that a GPU copies into",
         [] {
             const PretendedGpu gpu(pocl);
             kept.emplace(small_scene(), std::vector<std::string>{}, on("pocl"));
             kept_picture.emplace();
             for (int i = 0; i < 3; ++i) kept->render(small_view(), *kept_picture);
         }},
        {"a thread that draws, and that a destructor waits for",
         [&] {
             keep();
             static Worker worker;
         }},
        {"a destructor that draws",
         [&] {
             keep();
             static Late late;
         }},
        {"a library that is unloaded", unload},
        {"a library that is unloaded, by another thread, twice",
         [&] {
             on_thread(unload);
             on_thread(unload);
         }},
    };
    for (const auto& [name, work] : hosts) {
        INFO(name);
        const int status = status_of([&, &work = work] {
            work();
            std::exit(7);
        });
        if (status == skipped)
            WARN(name << ": PoCL is not there");
        else
            CHECK(status == 7);
    }
}
