// A command from outside the program: its row, and the program's output and exit code.
#include <gtest/gtest.h>

#include <cstdio>

#include "program_support.h"
#include "taut/core/error.h"

namespace taut::test::own_command {
namespace {

struct GreetFlags {
    std::string name;
    int times = 1;
    bool fails = false;
};

game::Action declareGreet(game::Options& options) {
    const auto flags = std::make_shared<GreetFlags>();
    options.value("NAME", flags->name, "Who is greeted").required();
    options.value("--times", flags->times, "How often").within(1, 9).showDefault();
    options.flag("--fail", flags->fails, "Do not reach anybody");
    options.footer("Example: taut greet you");
    return [flags] {
        if (flags->fails) throw core::Error(core::ErrorKind::inputOutput, flags->name + " is not at home");
        for (int i = 0; i < flags->times; ++i) std::printf("hello %s\n", flags->name.c_str());
        return 5;
    };
}

Outcome runWithGreet(const std::vector<std::string>& arguments) {
    std::vector<game::Command> commands = game::builtInCommands();
    commands.push_back({"greet", "Greet somebody", declareGreet});
    return run(arguments, commands);
}

TEST(OwnCommand, StandsInTheHelpOfTheProgramAndHasItsOwn) {
    EXPECT_TRUE(has(runWithGreet({"--help"}).out, "\n  greet                       Greet somebody\n"));
    EXPECT_FALSE(has(run({"--help"}).out, "greet"));
    const Outcome help = runWithGreet({"greet", "--help"});
    EXPECT_EQ(help.code, 0);
    EXPECT_EQ(help.out,
              "Greet somebody\n"
              "Usage: taut greet [OPTIONS] NAME\n\n"
              "Positionals:\n"
              "  NAME TEXT REQUIRED          Who is greeted\n\n"
              "Options:\n"
              "  -h,--help                   Print this help\n"
              "  --times INT:INT in [1 - 9]=1\n"
              "                              How often\n"
              "  --fail                      Do not reach anybody\n\n"
              "Example: taut greet you\n");
}

TEST(OwnCommand, RunsAndGivesTheProgramItsExitCode) {
    const Outcome twice = runWithGreet({"greet", "you", "--times", "2"});
    EXPECT_EQ(twice.code, 5);
    EXPECT_EQ(twice.out, "hello you\nhello you\n");
    const Outcome failed = runWithGreet({"greet", "you", "--fail"});
    EXPECT_EQ(failed.code, 6);
    EXPECT_EQ(failed.err, "taut: you is not at home\n");
}

TEST(OwnCommand, AnswersWrongUsageAsTheOthersDo) {
    struct Case {
        std::vector<std::string> arguments;
        std::string message;
    };
    for (const Case& c :
         {Case{{"greet"}, "NAME is required"}, Case{{"greet", "you", "me"}, "'me' is one word too many"},
          Case{{"greet", "you", "--tims", "2"}, "unknown flag --tims; did you mean --times?"},
          Case{{"greet", "you", "--times", "10"}, "--times: Value 10 not in range 1 to 9"},
          Case{{"greet", "you", "--times", "--fail"}, "--times: its value is missing before --fail"}}) {
        const Outcome outcome = runWithGreet(c.arguments);
        EXPECT_EQ(outcome.code, 2);
        EXPECT_EQ(outcome.err, "taut: " + c.message + "\nTry taut greet --help.\n");
    }
    EXPECT_EQ(runWithGreet({"gret"}).err, "taut: unknown command 'gret'; did you mean greet?\nTry taut --help.\n");
}

}  // namespace
}  // namespace taut::test::own_command
