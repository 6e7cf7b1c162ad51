#include "taut/pipeline/stages.h"

#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "taut/pipeline/bounded_queue.h"
#include "taut/pipeline/ordered_handover.h"

namespace taut::pipeline {
namespace {

constexpr std::size_t framesBetween = 2;  // more would cost memory and gain nothing: the slowest stage sets the pace

struct Numbered {
    std::int64_t number = 0;
    view::FrameView view;
};

struct Drawn {
    view::FrameView view;
    image::Image picture;
};

struct Line {
    explicit Line(std::size_t drawers) : pictures(framesBetween + drawers - 2) {}

    BoundedQueue<Numbered> views{framesBetween};
    OrderedHandover<Drawn> pictures;
    std::mutex mutex;
    std::exception_ptr failure;

    void keepFailure() {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
    }

    // Runs the loop of one stage; its failure is kept when it is the first, and ends the others.
    template <class Loop>
    void run(Loop&& loop) {
        try {
            loop();
        } catch (...) {
            keepFailure();
            views.abandon();
            pictures.abandon();
        }
    }

    void draw(const std::function<image::Image(const view::FrameView&)>& drawOne) {
        while (std::optional<Numbered> next = views.pop()) {
            image::Image picture;
            try {
                picture = drawOne(next->view);
            } catch (...) {
                keepFailure();
                views.abandon();
                pictures.endAt(next->number);
                return;
            }
            if (!pictures.put(next->number, {std::move(next->view), std::move(picture)})) return;
        }
    }
};

}  // namespace

void runStages(const Stages& stages) {
    Line line(1 + stages.moreDraws.size());
    const auto simulate = [&] {
        std::int64_t number = 0;
        while (std::optional<view::FrameView> view = stages.simulate())
            if (!line.views.push({number++, std::move(*view)})) return;
        line.pictures.endAt(number);
        line.views.close();
    };
    const auto encode = [&] {
        while (std::optional<Drawn> drawn = line.pictures.take()) stages.encode(drawn->view, drawn->picture);
    };
    std::vector<std::jthread> threads;
    line.run([&] {
        // Within, for a thread that cannot be started ends the others.
        threads.emplace_back([&] { line.run(simulate); });
        threads.emplace_back([&] { line.run(encode); });
        for (const auto& drawOne : stages.moreDraws)
            threads.emplace_back([&line, &drawOne] { line.run([&] { line.draw(drawOne); }); });
        line.draw(stages.draw);
    });
    for (std::jthread& thread : threads) thread.join();
    if (line.failure) std::rethrow_exception(line.failure);
}

}  // namespace taut::pipeline
