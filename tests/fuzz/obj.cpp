#include "taut/scene/private/obj_file.h"

#include "fuzz/support.h"

void taut::fuzz::readObj(View bytes) {
    scene::objMeshText(textOf(bytes), "fuzz.obj");
}
