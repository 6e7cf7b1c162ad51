// Evaluates the checks of a scenario while it is played. It knows neither goldens nor pictures.
#pragma once

#include <memory>
#include <vector>

#include "report/test_report.h"
#include "world/world.h"

namespace taut::regression {

class ScenarioChecks {
  public:
    // Throws core::Error(badContent) for a check that cannot be read or names what is not there.
    ScenarioChecks(const world::SceneSpec& spec, const world::World& world);
    ~ScenarioChecks();
    ScenarioChecks(const ScenarioChecks&) = delete;
    ScenarioChecks& operator=(const ScenarioChecks&) = delete;

    // At every tick, the start among them.
    void look(const world::World& world);

    // As the scenario lists them.
    std::vector<report::TestCheck> results() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace taut::regression
