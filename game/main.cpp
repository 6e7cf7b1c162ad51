#include "game/program.h"

int main(int argc, char** argv) {
    return taut::game::runProgram(argc, argv);
}
