#include "taut/report/gnuplot.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <vector>

#include "taut/core/error.h"
#include "taut/core/whole_file.h"

namespace taut::report {
namespace {

struct Outcome {
    bool ran = false;  // the program was there and ended by itself
    int code = -1;
    std::string said;  // on standard output and standard error
};

// A file in memory, gone with its last user.
class MemoryFile {
  public:
    explicit MemoryFile(const char* name) : descriptor_(::memfd_create(name, MFD_CLOEXEC)) {
        if (descriptor_ < 0) throw std::system_error(errno, std::generic_category(), name);
    }
    ~MemoryFile() { ::close(descriptor_); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    int descriptor() const { return descriptor_; }

    void fill(std::string_view text) {
        while (!text.empty()) {
            const ssize_t done = ::write(descriptor_, text.data(), text.size());
            if (done < 0 && errno == EINTR) continue;
            if (done < 0) throw std::system_error(errno, std::generic_category(), "gnuplot's script");
            text.remove_prefix(static_cast<std::size_t>(done));
        }
        ::lseek(descriptor_, 0, SEEK_SET);
    }
    std::string content() const {
        std::string text;
        char buffer[4096];
        ::lseek(descriptor_, 0, SEEK_SET);
        for (ssize_t got = 0; (got = ::read(descriptor_, buffer, sizeof buffer)) > 0;)
            text.append(buffer, static_cast<std::size_t>(got));
        while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
        return text;
    }

  private:
    int descriptor_;
};

Outcome runGnuplot(std::vector<std::string> arguments, const std::string& input) {
    arguments.insert(arguments.begin(), "gnuplot");
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    MemoryFile script("gnuplot-script");
    const MemoryFile said("gnuplot-messages");
    script.fill(input);

    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, script.descriptor(), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&files, said.descriptor(), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&files, said.descriptor(), STDERR_FILENO);
    pid_t process = -1;
    const int error = posix_spawnp(&process, argv[0], &files, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    if (error != 0) return {};
    int status = 0;
    while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    Outcome outcome{WIFEXITED(status), WIFEXITED(status) ? WEXITSTATUS(status) : -1, said.content()};
    if (outcome.code == 127 && outcome.said.empty()) outcome.ran = false;  // how a failed spawn may end
    return outcome;
}

void draw(const Chart& chart, Format format, const std::filesystem::path& path) {
    core::prepareFolderOf(path);
    const std::filesystem::path temporary = core::temporaryName(path);
    const auto fail = [&](const std::string& what) {
        std::error_code ignored;
        std::filesystem::remove(temporary, ignored);
        throw core::Error(core::ExitCode::inputOutput, fmt::format("{}: {}", path.string(), what));
    };
    // "-d": no settings of the user's own.
    const Outcome outcome = runGnuplot({"-d", "-"}, gnuplotScript(chart, format, temporary));
    if (!outcome.ran) fail(gnuplotMissing());
    std::error_code error;
    if (outcome.code != 0 || !std::filesystem::exists(temporary, error) ||
        std::filesystem::file_size(temporary, error) == 0)
        fail(fmt::format("gnuplot failed with exit code {}{}{}", outcome.code, outcome.said.empty() ? "" : ":\n",
                         outcome.said));
    std::filesystem::rename(temporary, path, error);
    if (error) fail("cannot rename the finished file: " + error.message());
}

}  // namespace

void writeChart(const Chart& chart, const std::filesystem::path& stem) {
    draw(chart, Format::svg, stem.string() + ".svg");
    draw(chart, Format::png, stem.string() + ".png");
}

std::string gnuplotVersion() {
    const Outcome outcome = runGnuplot({"--version"}, "");
    return outcome.ran && outcome.code == 0 ? outcome.said.substr(0, outcome.said.find('\n')) : "";
}

std::string gnuplotMissing() {
    return "gnuplot is not installed. Install the package 'gnuplot-nox'";
}

}  // namespace taut::report
