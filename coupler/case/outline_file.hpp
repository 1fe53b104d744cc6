#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

namespace dipper::cases {

/// The bench's section: z over x, straight between points with x rising from the toe to the rear.
using BenchOutline = std::vector<Eigen::Vector2d>;

/// Height of the outline at x: 0 in front of it, that of its end behind it.
double outline_height(const BenchOutline& outline, double x_m);

/// Reads an outline: CSV with the columns x_m,z_m; empty lines and lines that start with # are
/// ignored. x must not fall (where it is constant, the face is upright), z must not be negative.
/// Throws InputError with a message `file:line: what; what would be right` for every fault. \param
/// lines  if given: the line of each point
BenchOutline read_outline(const std::filesystem::path& file, std::vector<int>* lines = nullptr);

/// Writes the same format.
std::string to_csv(const BenchOutline& outline);

}  // namespace dipper::cases
