// Runs the program within the test, and keeps its output.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "game/command_table.h"
#include "game/program.h"
#include "support/text.h"

namespace taut::test {

struct Outcome {
    int code = 0;
    std::string out, err;
};

inline Outcome run(const std::vector<std::string>& arguments,
                   const std::vector<game::Command>& commands = game::builtInCommands()) {
    std::vector<const char*> argv = {"taut"};
    for (const std::string& argument : arguments) argv.push_back(argument.c_str());
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    Outcome outcome;
    outcome.code = game::runProgram(static_cast<int>(argv.size()), argv.data(), commands);
    outcome.out = testing::internal::GetCapturedStdout();
    outcome.err = testing::internal::GetCapturedStderr();
    return outcome;
}

}  // namespace taut::test
