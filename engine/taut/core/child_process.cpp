#include "taut/core/private/child_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <thread>

#include "taut/core/error.h"

namespace taut::core {
namespace {

// "NAME=value" of every variable that the child is to have.
std::vector<std::string> environmentOf(const ChildCommand& command) {
    std::vector<std::string> variables;
    for (char** variable = environ; *variable != nullptr; ++variable) {
        const std::string_view text = *variable;
        if (!command.environment.contains(std::string(text.substr(0, text.find('='))))) variables.emplace_back(text);
    }
    for (const auto& [name, value] : command.environment)
        if (value) variables.push_back(name + "=" + *value);
    return variables;
}

// As C wants them; the texts have to live on.
std::vector<char*> pointersTo(std::vector<std::string>& texts) {
    std::vector<char*> pointers;
    for (std::string& text : texts) pointers.push_back(text.data());
    pointers.push_back(nullptr);
    return pointers;
}

// Starts the program with the three standard streams given; `process` is its id. Returns an error number or 0.
int spawn(const ChildCommand& command, int input, int output, int errors, pid_t& process) {
    std::vector<std::string> arguments = command.arguments, variables = environmentOf(command);
    const std::vector<char*> argv = pointersTo(arguments), environment = pointersTo(variables);

    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, input, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&files, output, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&files, errors, STDERR_FILENO);

    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    posix_spawnattr_setpgroup(&attributes, 0);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes, &none);
    sigset_t asUsual;  // but for SIGXFSZ: a file that may grow no more is to end in a message
    sigemptyset(&asUsual);
    sigaddset(&asUsual, SIGPIPE);
    posix_spawnattr_setsigdefault(&attributes, &asUsual);

    const int error = ::posix_spawnp(&process, argv[0], &files, &attributes, argv.data(), environment.data());
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    return error;
}

ChildEnd endOf(int status) {
    if (WIFSIGNALED(status)) return {.signal = WTERMSIG(status)};
    return {.code = WEXITSTATUS(status)};
}

std::string contentOf(int descriptor) {
    std::string text;
    char buffer[4096];
    // By place and not by position: that of the file is the child's, which may still be writing.
    for (ssize_t got = 0; (got = ::pread(descriptor, buffer, sizeof buffer, static_cast<off_t>(text.size()))) > 0;)
        text.append(buffer, static_cast<std::size_t>(got));
    text.erase(text.find_last_not_of(" \n") + 1);
    return text;
}

}  // namespace

bool isInPath(const std::string& program) {
    if (program.find('/') != std::string::npos) return ::access(program.c_str(), X_OK) == 0;
    const char* variable = std::getenv("PATH");
    std::istringstream folders(variable != nullptr ? variable : "/usr/bin:/bin");
    for (std::string folder; std::getline(folders, folder, ':');)
        if (::access((std::filesystem::path(folder) / program).c_str(), X_OK) == 0) return true;
    return false;
}

std::string ChildEnd::text() const {
    if (hung) return "hung, and was ended";
    if (signal != 0) return "was ended by signal " + std::to_string(signal);
    return code == 0 ? "ended well" : "failed with exit code " + std::to_string(code);
}

ChildProcess::ChildProcess(const ChildCommand& command) : patience_(command.patience) {
    TAUT_EXPECTS(!command.arguments.empty());
    // A socket and not a pipe: writing to one whose reader has gone can be asked to return an error instead of
    // raising SIGPIPE, however the rest of the process handles signals.
    int ends[2] = {-1, -1};
    int error = ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) == 0 ? 0 : errno;
    input_ = ends[0];
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(patience_);
    const timeval longest{seconds.count(), std::chrono::microseconds(patience_ - seconds).count()};
    if (error == 0) ::setsockopt(input_, SOL_SOCKET, SO_SNDTIMEO, &longest, sizeof longest);
    output_ = ::memfd_create("output", MFD_CLOEXEC);
    errors_ = ::memfd_create("errors", MFD_CLOEXEC);
    if (error == 0 && (output_ < 0 || errors_ < 0)) error = errno;
    if (error == 0) error = spawn(command, ends[1], output_, errors_, process_);
    if (ends[1] >= 0) ::close(ends[1]);
    if (error == 0) return;
    for (const int descriptor : {input_, output_, errors_})
        if (descriptor >= 0) ::close(descriptor);
    throw Error(ErrorKind::inputOutput, "cannot run " + command.arguments.front() + ": " + std::strerror(error));
}

ChildProcess::~ChildProcess() {
    if (process_ > 0) {
        ::kill(process_, SIGKILL);
        wait();
    }
    closeInput();
    ::close(output_);
    ::close(errors_);
}

bool ChildProcess::write(std::span<const std::byte> bytes) {
    TAUT_EXPECTS(input_ >= 0);
    while (!bytes.empty()) {
        const ssize_t done = ::send(input_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (done < 0 && errno == EINTR) continue;
        if (done < 0) {
            hangs_ = errno == EAGAIN;
            return false;
        }
        bytes = bytes.subspan(done);
    }
    return true;
}

void ChildProcess::closeInput() {
    if (input_ >= 0) ::close(input_);
    input_ = -1;
}

ChildEnd ChildProcess::wait(const std::atomic<bool>* stop) {
    closeInput();
    if (process_ < 0) return end_;
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    int status = 0;
    pid_t ended = 0;
    while (!hangs_ && (stop == nullptr || !*stop) && (ended = ::waitpid(process_, &status, WNOHANG)) == 0) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        hangs_ = Clock::now() - start > patience_;
    }
    if (ended == 0) {
        ::kill(process_, SIGKILL);
        while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
        }
    }
    process_ = -1;
    end_ = endOf(status);
    end_.hung = hangs_;
    return end_;
}

std::string ChildProcess::output() const {
    return contentOf(output_);
}

std::string ChildProcess::errors() const {
    return contentOf(errors_);
}

ChildResult runChild(const ChildCommand& command, std::string_view input, const std::atomic<bool>* stop) {
    ChildProcess child(command);
    child.write(std::as_bytes(std::span(input.data(), input.size())));  // who does not read it all says why, by its end
    const ChildEnd end = child.wait(stop);
    return {end, child.output(), child.errors()};
}

}  // namespace taut::core
