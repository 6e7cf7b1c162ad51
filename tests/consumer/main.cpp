// Warnings are a project's own affair: with taut's this would not compile.
#include "taut/spec/spec.h"
#include "taut/world/world.h"

int main() {
    const double x = taut::world::World({}).tickSeconds();
    float y = x;
    return y > 0.0F ? 0 : 1;
}
