// csgrt: the command's main function, which turns exceptions into a message and an exit status.
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

#include "arguments.hpp"
#include "cache_folder.hpp"
#include "fatal_end.hpp"
#include "held_renderer.hpp"
#include "interrupt.hpp"
#ifdef CSGRT_LATE_IMAGE
#include "late_image.hpp"
#endif
#include "output.hpp"
#include "progress.hpp"

namespace csgrt::cli {

namespace {

constexpr int defect = 1;  ///< exit status of an exception that is not an Error

void print_error(const std::string& text) {
    const char* plain = std::getenv("NO_COLOR");
    bool colored = on_terminal() && !(plain && *plain);
    std::fprintf(stderr, "csgrt: %serror:%s %s\n", colored ? "\033[1;31m" : "", colored ? "\033[0m" : "", text.c_str());
}

int fail(const Error& error) {
    for (const Diagnostic& diagnostic : error.diagnostics()) print_error(format(diagnostic));
    return static_cast<int>(error.status());
}

/// Reports a lack of memory, without an allocation.
int fail_without_memory() noexcept {
    constexpr std::string_view text =
        "csgrt: error: not enough memory: try a smaller --size, fewer objects, or --max-memory\n";
    static_cast<void>(!write(STDERR_FILENO, text.data(), text.size()));
    return static_cast<int>(Status::out_of_memory);
}

/// Ends the process after an allocation failed where exceptions are not allowed, for example in a destructor of the
/// JSON library.
[[noreturn]] void on_terminate() {
    try {
        if (std::current_exception()) throw;
    } catch (const std::bad_alloc&) {
        _exit(fail_without_memory());
    } catch (...) {
    }
    std::abort();
}

/// Opens /dev/null for each of the three standard files that is closed, in the wrong direction so that its use fails.
/// Otherwise the next file to be opened would take the standard file's number and its reads or writes.
void hold_standard_files() {
    for (int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (fcntl(file, F_GETFD) < 0 && errno == EBADF)
            static_cast<void>(open("/dev/null", file == STDIN_FILENO ? O_WRONLY : O_RDONLY));
}

bool may_use_opencl(const Command& command) {
    return std::visit(
        []<class Arguments>(const Arguments& arguments) {
            if constexpr (requires { arguments.settings; } && !std::is_same_v<Arguments, InfoArguments>)
                return !arguments.settings.reference;
            else
                return std::is_same_v<Arguments, DevicesArguments>;
        },
        command);
}

int main_status(int argc, char** argv) noexcept {
    try {
        Command command = parse_arguments({argv + (argc > 0), argv + argc});
        if (may_use_opencl(command)) ensure_cache_folder();
        catch_fatal_ends();
#ifdef CSGRT_LATE_IMAGE
        ImageLoading loading(command);
#endif
        return static_cast<int>(std::visit([](const auto& arguments) { return run(arguments); }, command));
    } catch (const Error& error) {
        return fail(error);
    } catch (const std::bad_alloc&) {
        return fail_without_memory();
    } catch (const std::length_error&) {
        return fail_without_memory();
    } catch (const std::exception& error) {
        print_error(std::string("a defect of csgrt, please report it: ") + error.what());
        return defect;
    }
}

}  // namespace

Status run(const TextArguments& arguments) {
    print(arguments.text);
    return Status::ok;
}

}  // namespace csgrt::cli

#ifdef __linux__
/// Replaces abort() for all libraries, because a program's function comes before the system's. The system's abort()
/// would call PoCL's compiler's handler, which was installed after csgrt's.
extern "C" [[gnu::visibility("default")]] void abort() noexcept {
    csgrt::cli::on_abort(__builtin_return_address(0));
    for (;;) {
        raise(SIGABRT);
        std::signal(SIGABRT, SIG_DFL);
    }
}
#endif

int main(int argc, char** argv) {
    std::set_terminate(csgrt::cli::on_terminate);
    std::signal(SIGXFSZ, SIG_IGN);  // a write beyond the size limit of files then fails, and is reported
    csgrt::cli::hold_standard_files();
    csgrt::cli::catch_interrupts();
    return csgrt::cli::end_process(csgrt::cli::main_status(argc, argv));
}
