#include "taut/image/video_writer.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <vector>

#include "taut/core/error.h"
#include "taut/core/whole_file.h"

namespace taut::image {
namespace {

// Starts a program with the three standard streams given; returns its id, or the negative error number.
pid_t spawned(const std::vector<std::string>& arguments, int input, int output, int errors) {
    std::vector<char*> argv;
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);

    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    const auto give = [&](int from, int to) {
        if (from >= 0)
            posix_spawn_file_actions_adddup2(&files, from, to);
        else
            posix_spawn_file_actions_addopen(&files, to, "/dev/null", O_RDWR, 0);
    };
    give(input, STDIN_FILENO);
    give(output, STDOUT_FILENO);
    give(errors, STDERR_FILENO);

    // A process group of its own and no blocked signals: Ctrl-C on the terminal is ours to answer, and ffmpeg ends
    // because its input ends, with a whole file.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
    posix_spawnattr_setpgroup(&attributes, 0);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes, &none);

    pid_t process = -1;
    const int error = posix_spawnp(&process, argv[0], &files, &attributes, argv.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    return error == 0 ? process : -error;
}

bool isInPath(const std::string& program) {
    if (program.find('/') != std::string::npos) return ::access(program.c_str(), X_OK) == 0;
    const char* variable = std::getenv("PATH");
    std::istringstream folders(variable != nullptr ? variable : "/usr/bin:/bin");
    for (std::string folder; std::getline(folders, folder, ':');)
        if (::access((std::filesystem::path(folder) / program).c_str(), X_OK) == 0) return true;
    return false;
}

int statusOf(pid_t process) {
    int status = 0;
    while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
}

std::string textOf(int descriptor) {
    std::string text;
    char buffer[4096];
    ::lseek(descriptor, 0, SEEK_SET);
    for (ssize_t got = 0; (got = ::read(descriptor, buffer, sizeof buffer)) > 0;)
        text.append(buffer, static_cast<std::size_t>(got));
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
    return text;
}

std::string containerOf(const std::filesystem::path& path) {
    const std::string extension = path.extension().string();
    if (extension == ".mp4") return "mp4";
    if (extension == ".mov") return "mov";
    if (extension == ".mkv") return "matroska";
    return "";
}

}  // namespace

bool isVideoPath(const std::filesystem::path& path) {
    return !containerOf(path).empty();
}

VideoWriter::VideoWriter(std::filesystem::path path, VideoOptions options)
    : path_(std::move(path)), temporary_(core::temporaryName(path_)), options_(std::move(options)) {
    TAUT_EXPECTS(isVideoPath(path_));
    TAUT_EXPECTS(options_.fps > 0.0);
    if (!isInPath(options_.program))
        throw core::Error(core::ExitCode::inputOutput,
                          fmt::format("{}: {} is not installed. Install the package 'ffmpeg', or write pictures "
                                      "instead: -o {}/frame_######.png",
                                      path_.string(), options_.program, (path_.parent_path() / path_.stem()).string()));
    core::prepareFolderOf(path_);
}

VideoWriter::~VideoWriter() {
    if (process_ > 0) {
        ::kill(process_, SIGKILL);
        waitForEnd();
        ::unlink(temporary_.c_str());
    }
    if (messages_ >= 0) ::close(messages_);
}

void VideoWriter::start(int width, int height) {
    width_ = width;
    height_ = height;
    // A socket and not a pipe: writing to one whose reader has gone can be asked to return an error instead of
    // raising SIGPIPE, whatever the rest of the process does with signals.
    int ends[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
        throw core::Error(core::ExitCode::inputOutput, fmt::format("{}: {}", path_.string(), std::strerror(errno)));
    messages_ = ::memfd_create("ffmpeg-messages", MFD_CLOEXEC);

    std::vector<std::string> arguments = {options_.program,
                                          "-hide_banner",
                                          "-loglevel",
                                          "error",
                                          "-nostdin",
                                          "-xerror",
                                          "-y",
                                          "-f",
                                          "rawvideo",
                                          "-pixel_format",
                                          "rgb24",
                                          "-video_size",
                                          fmt::format("{}x{}", width, height),
                                          "-framerate",
                                          fmt::format("{}", options_.fps),
                                          "-i",
                                          "pipe:0",
                                          "-an",
                                          "-vf",
                                          "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv",
                                          "-c:v",
                                          "libx264",
                                          "-preset",
                                          "veryfast",
                                          "-crf",
                                          fmt::format("{}", options_.quality),
                                          "-pix_fmt",
                                          "yuv420p",
                                          "-colorspace",
                                          "bt709",
                                          "-color_primaries",
                                          "bt709",
                                          "-color_trc",
                                          "iec61966-2-1"};
    const std::string container = containerOf(path_);
    if (container != "matroska") arguments.insert(arguments.end(), {"-movflags", "+faststart"});
    arguments.insert(arguments.end(), {"-f", container, "file:" + temporary_.string()});

    const pid_t process = spawned(arguments, ends[1], -1, messages_);
    ::close(ends[1]);
    pipe_ = ends[0];
    if (process > 0) {
        process_ = process;
        return;
    }
    ::close(pipe_);
    pipe_ = -1;
    throw core::Error(core::ExitCode::inputOutput,
                      fmt::format("{}: cannot run {}: {}", path_.string(), options_.program, std::strerror(-process)));
}

void VideoWriter::write(std::int64_t /*frame*/, const Image& image) {
    TAUT_EXPECTS(image.isWhole());
    if (process_ < 0) start(image.width, image.height);
    TAUT_EXPECTS(image.width == width_ && image.height == height_);
    const std::uint8_t* data = image.rgb.data();
    std::size_t left = image.rgb.size();
    while (left > 0) {
        const ssize_t done = ::send(pipe_, data, left, MSG_NOSIGNAL);
        if (done < 0 && errno == EINTR) continue;
        if (done < 0) fail("ended before it had all pictures");
        data += done;
        left -= static_cast<std::size_t>(done);
    }
}

void VideoWriter::finish() {
    if (process_ < 0) return;  // no picture, no video
    const int status = waitForEnd();
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        fail(WIFEXITED(status) ? fmt::format("failed with exit code {}", WEXITSTATUS(status))
                               : fmt::format("was ended by signal {}", WTERMSIG(status)));
    }
    // ffmpeg ends well after some failures to write the end of the file; raw pictures give it nothing else to report.
    if (!textOf(messages_).empty()) fail("reported");
    if (::rename(temporary_.c_str(), path_.c_str()) != 0) fail(fmt::format("wrote no file: {}", std::strerror(errno)));
}

// Closes the pipe, which tells ffmpeg that the last picture has come, and waits for it.
int VideoWriter::waitForEnd() {
    if (pipe_ >= 0) ::close(pipe_);
    pipe_ = -1;
    const int status = statusOf(process_);
    process_ = -1;
    return status;
}

void VideoWriter::fail(const std::string& what) {
    if (process_ > 0) waitForEnd();
    ::unlink(temporary_.c_str());
    const std::string text = textOf(messages_);
    throw core::Error(core::ExitCode::inputOutput, fmt::format("{}: {} {}{}{}", path_.string(), options_.program, what,
                                                               text.empty() ? "" : ":\n", text));
}

std::filesystem::path VideoWriter::companion(const std::string& name) const {
    return path_.parent_path() / fmt::format("{}.{}", path_.stem().string(), name);
}

std::string ffmpegVersion(const std::string& program) {
    const int output = ::memfd_create("ffmpeg-version", MFD_CLOEXEC);
    const pid_t process = spawned({program, "-version"}, -1, output, -1);
    std::string text;
    if (process > 0 && statusOf(process) == 0) text = textOf(output);
    ::close(output);
    return text.substr(0, text.find('\n'));
}

}  // namespace taut::image
