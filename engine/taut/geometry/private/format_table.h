// Formats that geometry is written in, one row each; which one is meant tells how a file's name ends. To add a format,
// write one file with its writer and its row, and one line in format_table.cpp.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "taut/core/table.h"
#include "taut/geometry/geometry_sink.h"
#include "taut/geometry/points_writer.h"

namespace taut::geometry {

struct Format {
    std::string name;                  // "USD"
    std::vector<std::string> endings;  // of names of files, ".usda"; helps name the first
    std::string readers{};             // programs, for helps: "Houdini, Blender"; may be empty

    // Drawn geometry, or points of targets: exactly one of the two is set. They throw core::Error(inputOutput).
    std::function<std::unique_ptr<GeometrySink>(const std::filesystem::path&, const GeometryOptions&)> makeSink{};
    std::function<std::unique_ptr<PointsWriter>(const std::filesystem::path&, const std::vector<std::string>& targets)>
        makePoints{};

    bool mayTear = false;           // triangles may change; otherwise its sink throws TopologyChanged
    bool hasDigits = false;         // GeometryOptions::digits
    std::string needsNormals{};     // why GeometryOptions::normals may not be false; empty: it may
    std::size_t mostKeys = 0;       // frames a mesh that its readers promise room for; 0: any number
    std::string limitingReaders{};  // who promises that
};

using Formats = core::Table<Format>;

Formats builtInFormats();

// Rows for drawn geometry, or for points.
enum class Holds { surfaces, points };
std::vector<const Format*> formatsThat(const Formats& formats, Holds what);

// The one of them that files of that name are in; nullptr when there is none.
const Format* formatOf(const Formats& formats, Holds what, const std::filesystem::path& path);

bool isIn(const Format& format, const std::filesystem::path& path);

}  // namespace taut::geometry
