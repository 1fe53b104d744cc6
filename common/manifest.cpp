#include "common/manifest.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <set>
#include <stdexcept>
#include <system_error>

#include "common/draft_file.hpp"
#include "common/input_error.hpp"
#include "common/sha256.hpp"

namespace dipper {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kDigits = 64;

}  // namespace

void sync(const fs::path& path) {
  const int fd = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) throw std::system_error(errno, std::generic_category(), path.string());
  const int failed = fsync(fd);
  const int why = errno;
  close(fd);
  // Some file systems cannot sync a folder, and return an error.
  if (failed != 0 && why != EINVAL)
    throw std::system_error(why, std::generic_category(), path.string());
}

void seal(const fs::path& folder) {
  std::vector<fs::path> parts;
  for (const auto& f : fs::directory_iterator(folder)) parts.push_back(f.path().filename());
  seal(folder, parts);
}

void seal(const fs::path& folder, const std::vector<fs::path>& parts) {
  std::set<fs::path> files, folders{folder};
  const auto add = [&](const fs::path& path) {
    if (fs::is_directory(path)) folders.insert(path);
    if (fs::is_regular_file(path) && path.filename() != kManifest) files.insert(path);
  };
  for (const fs::path& part : parts) {
    add(folder / part);
    if (!fs::is_directory(folder / part)) continue;
    for (const auto& f : fs::recursive_directory_iterator(folder / part)) add(f.path());
  }
  const DraftFile manifest(folder / kManifest);  // killed here, it leaves none
  std::ofstream out(manifest.path(), std::ios::binary);
  for (const fs::path& file : files) {
    sync(file);
    out << sha256_file(file) << "  " << file.lexically_relative(folder).generic_string() << '\n';
  }
  out << "# files: " << files.size() << '\n';
  out.close();
  if (!out) throw std::runtime_error("cannot write " + (folder / kManifest).string());
  sync(manifest.path());
  manifest.keep();
  for (const fs::path& f : folders) sync(f);
}

std::string damage_of(const fs::path& folder) {
  const fs::path manifest = folder / kManifest;
  std::ifstream in(manifest, std::ios::binary);
  if (!in) return manifest.string() + " is missing";
  const std::string cut = manifest.string() + " has changed since it was written";
  std::size_t files = 0;
  for (std::string line; std::getline(in, line); ++files) {
    if (line == "# files: " + std::to_string(files) && !in.eof()) return "";
    if (line.size() < kDigits + 3 || line.compare(kDigits, 2, "  ") != 0) return cut;
    const fs::path file = folder / line.substr(kDigits + 2);
    if (!fs::is_regular_file(file)) return file.string() + " is missing";
    if (sha256_file(file) != line.substr(0, kDigits))
      return file.string() + " has changed since it was written: its SHA-256 differs";
  }
  return cut;
}

void require_undamaged(const fs::path& folder) {
  if (!fs::exists(folder / kManifest)) return;
  const std::string damage = damage_of(folder);
  if (damage.empty()) return;
  throw InputError(
      {{{},
        0,
        "",
        damage + "; restore it, or accept it as it is: remove " + (folder / kManifest).string()}});
}

void rename_sealed(const fs::path& from, const fs::path& to) {
  fs::rename(from, to);
  sync(to.parent_path());
}

fs::path set_aside(const fs::path& path) {
  const fs::path aside = path.string() + ".damaged";
  fs::remove_all(aside);
  fs::rename(path, aside);
  return aside;
}

}  // namespace dipper
