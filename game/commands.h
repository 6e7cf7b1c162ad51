// The commands of the program: each adds its name, flags and help, and sets what is to be done when it is chosen.
// A new command is a new file and a line here and in the table of program.cpp.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace taut::game {

using Action = std::function<int()>;  // returns the exit code

void addAtlas(CLI::App& app, Action& chosen);
void addChart(CLI::App& app, Action& chosen);
void addCheck(CLI::App& app, Action& chosen);
void addDoctor(CLI::App& app, Action& chosen);
void addInfo(CLI::App& app, Action& chosen);
void addPlan(CLI::App& app, Action& chosen);
void addPlay(CLI::App& app, Action& chosen);
void addRecord(CLI::App& app, Action& chosen);
void addRender(CLI::App& app, Action& chosen);
void addReplay(CLI::App& app, Action& chosen);
void addSchema(CLI::App& app, Action& chosen);
void addSheet(CLI::App& app, Action& chosen);
void addTest(CLI::App& app, Action& chosen);

}  // namespace taut::game
