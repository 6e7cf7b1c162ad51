#include "taut/pipeline/stages.h"

#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "taut/pipeline/bounded_queue.h"

namespace taut::pipeline {
namespace {

constexpr std::size_t framesBetween = 2;  // more would cost memory and gain nothing: the slowest stage sets the pace

struct Drawn {
    view::FrameView view;
    image::Image picture;
};

struct Line {
    BoundedQueue<view::FrameView> views{framesBetween};
    BoundedQueue<Drawn> pictures{framesBetween};
    std::mutex mutex;
    std::exception_ptr failure;

    // Runs the loop of one stage; its failure is kept when it is the first, and ends the others.
    template <class Loop>
    void run(Loop&& loop) {
        try {
            loop();
        } catch (...) {
            {
                const std::lock_guard lock(mutex);
                if (!failure) failure = std::current_exception();
            }
            views.abandon();
            pictures.abandon();
        }
    }
};

}  // namespace

void runStages(const Stages& stages) {
    Line line;
    const auto simulate = [&] {
        while (std::optional<view::FrameView> view = stages.simulate())
            if (!line.views.push(std::move(*view))) return;
        line.views.close();
    };
    const auto encode = [&] {
        while (const std::optional<Drawn> drawn = line.pictures.pop()) stages.encode(drawn->view, drawn->picture);
    };
    std::jthread simulating, encoding;
    line.run([&] {
        // Within, for a thread that cannot be started ends the other.
        simulating = std::jthread([&] { line.run(simulate); });
        encoding = std::jthread([&] { line.run(encode); });
        while (std::optional<view::FrameView> view = line.views.pop()) {
            image::Image picture = stages.draw(*view);
            if (!line.pictures.push({std::move(*view), std::move(picture)})) return;
        }
        line.pictures.close();
    });
    if (simulating.joinable()) simulating.join();
    if (encoding.joinable()) encoding.join();
    if (line.failure) std::rethrow_exception(line.failure);
}

}  // namespace taut::pipeline
