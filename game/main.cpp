#include "game/program.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

int main(int argc, char** argv) {
#ifdef __GLIBC__
    // The memory of a picture is used again by the next. Given back in between, each of its pages would cost a fault.
    ::mallopt(M_TRIM_THRESHOLD, 512 << 20);
    ::mallopt(M_MMAP_THRESHOLD, 32 << 20);
#endif
    return taut::game::runProgram(argc, argv);
}
