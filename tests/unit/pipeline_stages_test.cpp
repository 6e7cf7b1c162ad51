#include "taut/pipeline/stages.h"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

namespace taut::pipeline {
namespace {

// Events that threads wait for; waiting gives up after a time that no working run comes near.
class Events {
  public:
    void happen(const std::string& name) {
        const std::lock_guard lock(mutex_);
        names_.insert(name);
        changed_.notify_all();
    }
    bool waitFor(const std::string& name) {
        std::unique_lock lock(mutex_);
        return changed_.wait_for(lock, std::chrono::seconds(20), [&] { return names_.count(name) > 0; });
    }

  private:
    std::mutex mutex_;
    std::condition_variable changed_;
    std::set<std::string> names_;
};

std::string named(const char* stage, std::int64_t frame) {
    return stage + std::to_string(frame);
}

std::function<std::optional<view::FrameView>()> framesUpTo(int count) {
    return [next = 0, count]() mutable -> std::optional<view::FrameView> {
        if (next == count) return std::nullopt;
        view::FrameView view;
        view.frame = next++;
        return view;
    };
}

image::Image pictureOf(const view::FrameView& view) {
    return {1, 1, {static_cast<std::uint8_t>(view.frame), 0, 0}};
}

TEST(Stages, EveryFrameIsDrawnAndEncodedOnceAndInOrder) {
    std::vector<std::int64_t> encoded;
    runStages({framesUpTo(50), pictureOf, [&](const view::FrameView& view, const image::Image& picture) {
                   EXPECT_EQ(picture.rgb[0], view.frame);
                   encoded.push_back(view.frame);
               }});
    ASSERT_EQ(encoded.size(), 50U);
    for (std::size_t i = 0; i < encoded.size(); ++i) EXPECT_EQ(encoded[i], static_cast<std::int64_t>(i));
}

TEST(Stages, NoFramesIsARunWithoutPictures) {
    runStages({framesUpTo(0), pictureOf, [](const auto&, const auto&) { ADD_FAILURE(); }});
}

// Each stage waits in frame n until the one before it is at work on frame n + 1: one after the other, they would never
// end.
TEST(Stages, WorkOnThreeSuccessiveFramesAtOnce) {
    Events events;
    const int count = 5;
    auto next = framesUpTo(count);
    runStages({[&] {
                   auto view = next();
                   if (view) events.happen(named("simulate", view->frame));
                   return view;
               },
               [&](const view::FrameView& view) {
                   events.happen(named("draw", view.frame));
                   if (view.frame + 1 < count) EXPECT_TRUE(events.waitFor(named("simulate", view.frame + 1)));
                   return pictureOf(view);
               },
               [&](const view::FrameView& view, const image::Image&) {
                   if (view.frame + 1 < count) EXPECT_TRUE(events.waitFor(named("draw", view.frame + 1)));
               }});
}

TEST(Stages, DrawingStaysOnTheCallingThread) {
    const auto caller = std::this_thread::get_id();
    runStages({framesUpTo(3),
               [&](const view::FrameView& view) {
                   EXPECT_EQ(std::this_thread::get_id(), caller);
                   return pictureOf(view);
               },
               [&](const auto&, const auto&) { EXPECT_NE(std::this_thread::get_id(), caller); }});
}

// Frame 0 is drawn only when the others that fit beside it are; the output is in order all the same.
TEST(Stages, SeveralDrawAtOnceAndFramesStayInOrder) {
    Events events;
    const auto draw = [&](const view::FrameView& view) {
        if (view.frame == 0) EXPECT_TRUE(events.waitFor("draw2"));
        events.happen(named("draw", view.frame));
        return pictureOf(view);
    };
    std::vector<std::int64_t> encoded;
    const auto encode = [&](const view::FrameView& view, const image::Image& picture) {
        EXPECT_EQ(picture.rgb[0], view.frame);
        encoded.push_back(view.frame);
    };
    runStages({framesUpTo(40), draw, encode, {draw, draw}});
    ASSERT_EQ(encoded.size(), 40U);
    for (std::size_t i = 0; i < encoded.size(); ++i) EXPECT_EQ(encoded[i], static_cast<std::int64_t>(i));
}

TEST(Stages, FramesBeforeOneThatCannotBeDrawnAreEncoded) {
    // Frame 3 fails while 2 is still being drawn.
    Events events;
    const auto draw = [&](const view::FrameView& view) {
        if (view.frame == 2) EXPECT_TRUE(events.waitFor("failing"));
        if (view.frame == 3) {
            events.happen("failing");
            throw std::runtime_error("draw");
        }
        return pictureOf(view);
    };
    std::vector<std::int64_t> encoded;
    const auto encode = [&](const view::FrameView& view, const image::Image&) { encoded.push_back(view.frame); };
    EXPECT_THROW(runStages({framesUpTo(1000), draw, encode, {draw, draw}}), std::runtime_error);
    EXPECT_EQ(encoded, (std::vector<std::int64_t>{0, 1, 2}));
}

TEST(Stages, FailureToEncodeEndsAllThatDraw) {
    std::atomic<int> drawn = 0;
    const auto draw = [&](const view::FrameView& view) {
        ++drawn;
        return pictureOf(view);
    };
    const auto encode = [](const view::FrameView& view, const image::Image&) {
        if (view.frame == 3) throw std::runtime_error("full");
    };
    EXPECT_THROW(runStages({framesUpTo(100000), draw, encode, {draw, draw, draw}}), std::runtime_error);
    EXPECT_LT(drawn, 20);  // four in hand, five that wait, and those before
}

TEST(Stages, SimulationRunsAheadByAFewFramesOnly) {
    std::atomic<std::int64_t> simulated = 0;
    auto next = framesUpTo(100);
    std::int64_t most = 0;
    runStages(
        {[&] {
             auto view = next();
             if (view) simulated = view->frame;
             return view;
         },
         pictureOf,
         [&](const view::FrameView& view, const image::Image&) { most = std::max(most, simulated - view.frame); }});
    // Two in each queue and one in the hands of the simulation and of the drawing each.
    EXPECT_LE(most, 6);
}

TEST(Stages, FailureOfAnyStageEndsTheOthersAndIsRethrown) {
    const auto throwsAt = [](std::int64_t frame, const char* what) {
        if (frame == 3) throw std::runtime_error(what);
    };
    for (const std::string failing : {"simulate", "draw", "encode"}) {
        std::int64_t lastEncoded = -1;
        auto next = framesUpTo(1000);
        const Stages stages{[&] {
                                auto view = next();
                                if (failing == "simulate") throwsAt(view->frame, "simulate");
                                return view;
                            },
                            [&](const view::FrameView& view) {
                                if (failing == "draw") throwsAt(view.frame, "draw");
                                return pictureOf(view);
                            },
                            [&](const view::FrameView& view, const image::Image&) {
                                if (failing == "encode") throwsAt(view.frame, "encode");
                                lastEncoded = view.frame;
                            }};
        try {
            runStages(stages);
            ADD_FAILURE() << failing;
        } catch (const std::runtime_error& error) {
            EXPECT_EQ(error.what(), failing);
        }
        EXPECT_LT(lastEncoded, 3);
    }
}

// Memory for the stack of one more thread, and no more: the stage that there is may not wait for the other for ever.
TEST(Stages, ThreadThatCannotBeStartedEndsTheRun) {
    const auto run = [] {
        ::alarm(20);
        constexpr std::size_t stack = std::size_t{1} << 30U;
        pthread_attr_t attributes;
        pthread_attr_init(&attributes);
        pthread_attr_setstacksize(&attributes, stack);
        pthread_setattr_default_np(&attributes);
        std::size_t pages = 0;
        std::ifstream("/proc/self/statm") >> pages;
        const rlimit limit{pages * 4096 + stack + stack / 2, RLIM_INFINITY};
        ::setrlimit(RLIMIT_AS, &limit);
        try {
            runStages({[] { return std::optional(view::FrameView{}); }, [](const auto&) { return image::Image{}; },
                       [](const auto&, const auto&) {}});
        } catch (const std::system_error&) {
            std::_Exit(0);
        }
        std::_Exit(1);
    };
    EXPECT_EXIT(run(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace taut::pipeline
