// SHA-256 of whole cases, and the files they are made of.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "coupler/case/case.hpp"

namespace dipper::cases {

/// Every file a case needs besides case.yaml: model, motion, meshes, the YAML files beside those of
/// dipper and truck, a profile, and the files of the shapes that its classes use. Sorted, each
/// once; a file need not exist.
std::vector<std::filesystem::path> referenced_files(const Case& c);

/// Files in `folder` that make up a shape: its name with any extension. Sorted.
std::vector<std::filesystem::path> shape_files(const std::filesystem::path& folder,
                                               const std::string& shape);

/// One hash of everything that determines a run's results: the canonical text, with each path
/// replaced by the hash of its file, the YAML files beside the meshes, and the files of the shapes.
/// Moving the checkout does not change it; a byte in a referenced file does. Throws
/// std::runtime_error when a file is missing.
std::string case_hash(const Case& c);

}  // namespace dipper::cases
