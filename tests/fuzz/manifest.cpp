#include "taut/regression/manifest.h"

#include "fuzz/support.h"

void taut::fuzz::readManifest(View bytes) {
    regression::readManifestText(std::string(textOf(bytes)), "manifest.json");
}
