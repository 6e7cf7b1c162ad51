// A program that runs as a child process: it reads our output, and its messages are kept. Independent of the purpose of
// the program.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace taut::core {

// Whether there is such a program: a path, or a name that is looked up in PATH.
bool isInPath(const std::string& program);

struct ChildCommand {
    std::vector<std::string> arguments;  // the program, a path or a name in PATH, and its arguments
    // Changes of the environment of this process: a value, or none to remove a variable.
    std::map<std::string, std::optional<std::string>> environment{};
    // Time without reading input or ending after which it counts as hanging and is killed.
    std::chrono::milliseconds patience = std::chrono::minutes(10);
};

// How a process ended: by an exit code of its own, or by a signal.
struct ChildEnd {
    int code = 0;       // 0 where a signal ended it
    int signal = 0;     // 0 where none did
    bool hung = false;  // we ended it, for our patience was at an end
    bool succeeded() const { return code == 0 && signal == 0; }
    std::string text() const;  // "failed with exit code 3", "was ended by signal 9", "hung", "ended well"
};

// The child belongs to a process group of its own and has no signal blocked: Ctrl-C on the terminal is ours to answer.
class ChildProcess {
  public:
    // Starts it; throws core::Error(inputOutput) when it cannot be run.
    explicit ChildProcess(const ChildCommand& command);
    ~ChildProcess();  // kills the running program
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    // To its standard input; waits until the child takes it. False when the child does not read any more, or hangs.
    bool write(std::span<const std::byte> bytes);

    // Closes its standard input and waits for its end; kills it as soon as `stop` is set, or when it hangs. Only the
    // first call waits.
    ChildEnd wait(const std::atomic<bool>* stop = nullptr);

    // Output so far on standard output and on standard error, without blanks and line ends at the end.
    std::string output() const;
    std::string errors() const;

  private:
    void closeInput();

    pid_t process_ = -1;
    int input_ = -1;                 // our end of its standard input
    int output_ = -1, errors_ = -1;  // files in memory
    std::chrono::milliseconds patience_;
    bool hangs_ = false;
    ChildEnd end_;
};

struct ChildResult {
    ChildEnd end;
    std::string output, errors;
};

// Runs a program to its end with `input` on its standard input. Throws as the constructor of ChildProcess does.
ChildResult runChild(const ChildCommand& command, std::string_view input = {}, const std::atomic<bool>* stop = nullptr);

}  // namespace taut::core
