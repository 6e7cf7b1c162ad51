#include "taut/regression/suite.h"

#include <algorithm>
#include <exception>
#include <mutex>
#include <numeric>
#include <optional>
#include <system_error>
#include <thread>

#include "taut/core/error.h"
#include "taut/regression/goldens.h"
#include "taut/regression/judging.h"
#include "taut/scene/private/body_size.h"

namespace taut::regression {
namespace {

class Suite {
  public:
    Suite(const std::vector<Scenario>& scenarios, const SuiteOptions& options, const Manifest& manifest,
          const std::atomic<bool>& stop)
        : scenarios_(scenarios),
          options_(options),
          manifest_(manifest),
          stop_(stop),
          results_(scenarios.size()),
          order_(longestFirst(scenarios)) {}
    void run() {
        const int count = std::clamp(options_.sideBySide, 1, std::max(1, static_cast<int>(scenarios_.size())));
        std::vector<std::jthread> workers;
        try {
            for (int i = 1; i < count; ++i) workers.emplace_back([this] { work(); });
        } catch (const std::system_error&) {  // no more threads: the existing ones do it
        }
        work();
        workers.clear();  // joins
        if (failure_) std::rethrow_exception(failure_);
    }

    const std::string& renderer() const { return rendererName_; }
    std::vector<report::TestScenario> results() {
        std::vector<report::TestScenario> all;
        for (auto& result : results_)
            if (result) all.push_back(std::move(*result));
        return all;
    }

  private:
    void work() {
        Drawer drawer(options_.drawing);
        for (std::size_t i = next_++; i < order_.size() && !stop_ && !failed_; i = next_++) {
            try {
                play(order_[i], drawer);
            } catch (...) {
                const std::lock_guard lock(mutex_);
                if (!failure_) failure_ = std::current_exception();
                failed_ = true;
            }
        }
    }

    void play(std::size_t i, Drawer& drawer) {
        const Scenario& scenario = scenarios_[i];
        PlayOptions options;
        options.threads = options_.threadsEach;
        const Goldens goldens{options_.goldens, manifest_, options_.bits};
        if (!isOutdated(scenario, goldens)) options.storedState = storedStates(options_.goldens, scenario);
        report::TestScenario result;
        try {
            const Played played = playScenario(scenario, drawer, options, stop_);
            result = played.interrupted ? unfinished(scenario, played)
                                        : judged(scenario, played, goldens, options_.requiresGoldens);
        } catch (const core::Error& error) {
            if (error.kind() != core::ErrorKind::badContent) throw;
            result = brokenScenario(scenario, error.what());
        }
        const std::lock_guard lock(mutex_);
        if (!drawer.renderer().empty()) rendererName_ = drawer.renderer();
        results_[i] = std::move(result);
        if (options_.scenarioDone) options_.scenarioDone(++done_, *results_[i]);
    }

    const std::vector<Scenario>& scenarios_;
    const SuiteOptions& options_;
    const Manifest& manifest_;
    const std::atomic<bool>& stop_;
    std::vector<std::optional<report::TestScenario>> results_;
    std::vector<std::size_t> order_;
    std::atomic<std::size_t> next_ = 0;
    std::atomic<bool> failed_ = false;
    int done_ = 0;
    std::string rendererName_;
    std::mutex mutex_;
    std::exception_ptr failure_;
};

}  // namespace

std::vector<std::size_t> longestFirst(const std::vector<Scenario>& scenarios) {
    std::vector<double> costs;
    for (const Scenario& scenario : scenarios)
        costs.push_back(scene::sizeOf(scenario.spec).bytes() * scenario.spec.run.seconds);
    std::vector<std::size_t> order(costs.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return costs[a] > costs[b]; });
    return order;
}

std::function<std::optional<std::vector<std::byte>>(const GoldenRequest&)> storedStates(const GoldenFolder& folder,
                                                                                        const Scenario& scenario) {
    return [folder, name = scenario.name](const GoldenRequest& request) {
        return storedState(folder, name, request.key());
    };
}

std::vector<report::TestScenario> runSuite(const std::vector<Scenario>& scenarios, const SuiteOptions& options,
                                           const Manifest& manifest, std::string& renderer,
                                           const std::atomic<bool>& stop) {
    Suite suite(scenarios, options, manifest, stop);
    suite.run();
    renderer = suite.renderer();
    return suite.results();
}

}  // namespace taut::regression
