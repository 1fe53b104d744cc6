// A run's page as a film and as a picture.
#pragma once

#include <filesystem>
#include <string>

#include "common/reporter.hpp"

namespace dipper::analysis::report {

struct FilmOptions {
  std::filesystem::path video;   ///< an .mp4; empty: none
  std::filesystem::path poster;  ///< a .png or .jpg; empty: none
  bool any() const { return !video.empty() || !poster.empty(); }
};

/// A film has 15 pictures a second and no more than this many: a long run plays faster, by a whole
/// number.
constexpr int kFilmPictures = 900;

/// The fault that prevents drawing, "" when there is none: a missing program, with its package, a
/// file name without a known extension, a missing folder.
std::string film_obstacle(const FilmOptions& options);

/// Opens the page in a headless browser and writes film and picture; leaves no partial file. The
/// poster is the moment at which the dipper, on its way out of the rock, holds most. Throws
/// std::runtime_error when browser or ffmpeg fail, or take more than a minute over one picture.
void write_film(const std::filesystem::path& page, const FilmOptions& options, Reporter& reporter);

}  // namespace dipper::analysis::report
