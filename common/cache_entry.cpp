#include "common/cache_entry.hpp"

#include <unistd.h>

#include <chrono>
#include <set>
#include <system_error>
#include <thread>
#include <vector>

#include "common/file_lock.hpp"
#include "common/manifest.hpp"
#include "common/sha256.hpp"
#include "common/text_file.hpp"
#include "common/warn.hpp"

namespace dipper {
namespace fs = std::filesystem;
namespace {

/// Names of parts are ENTRY.PID.part.
fs::path entry_of(const fs::path& part) {
  return fs::path(part).replace_extension().replace_extension();
}

/// Removes the parts in the folder that nobody is writing.
void sweep(const fs::path& folder, const fs::path& locked_entry) {
  std::vector<fs::path> parts;
  for (const auto& f : fs::directory_iterator(folder))
    if (f.path().extension() == ".part") parts.push_back(f.path());
  for (const fs::path& part : parts) {
    FileLock lock(writers_lock(part));
    std::error_code ignored;  // another process may be removing them, too
    if (entry_of(part) == locked_entry || lock.try_lock()) fs::remove_all(part, ignored);
  }
}

}  // namespace

std::string deck_hash(std::string what, const std::vector<fs::path>& files, const fs::path& deck) {
  const auto add = [&](const fs::path& file) {
    const std::optional<std::string> bytes = read_bytes(file);
    if (!bytes) throw std::runtime_error(file.string() + ": cannot be read");
    what += *bytes;
  };
  for (const fs::path& file : files) add(file);
  std::set<fs::path> sorted;
  for (const auto& f : fs::directory_iterator(deck))
    if (f.is_regular_file() && f.path().filename() != "case.in" &&
        f.path().filename() != "achieved.csv")  // what an earlier run has counted
      sorted.insert(f.path());
  for (const fs::path& file : sorted) {
    what += file.filename().string() + '\n';
    add(file);
  }
  return sha256(what);
}

fs::path writers_lock(const fs::path& entry_or_part) {
  const bool part = entry_or_part.extension() == ".part";
  return (part ? entry_of(entry_or_part) : entry_or_part).string() + ".lock";
}

bool is_sound(const fs::path& entry) { return fs::exists(entry) && damage_of(entry).empty(); }

struct CacheWriter::State {
  explicit State(const fs::path& entry_folder)
      : entry(entry_folder), lock(writers_lock(entry_folder)) {}

  fs::path entry, part;
  FileLock lock;
};

CacheWriter::CacheWriter(std::unique_ptr<State> state) : state_(std::move(state)) {}

CacheWriter::~CacheWriter() {
  std::error_code ignored;
  if (is_needed()) fs::remove_all(part(), ignored);
}

std::unique_ptr<CacheWriter> CacheWriter::begin(const fs::path& entry) {
  fs::create_directories(entry.parent_path());
  auto state = std::make_unique<State>(entry);
  if (!state->lock.try_lock()) return nullptr;
  sweep(entry.parent_path(), entry);
  if (const std::string damage = fs::exists(entry) ? damage_of(entry) : ""; !damage.empty())
    warn(damage + "; the entry is now " + set_aside(entry).string() + " and is made again");
  if (!fs::exists(entry)) {
    state->part = entry.string() + '.' + std::to_string(getpid()) + ".part";
    fs::create_directory(state->part);
  }
  return std::unique_ptr<CacheWriter>(new CacheWriter(std::move(state)));
}

bool CacheWriter::is_needed() const { return !state_->part.empty(); }

const fs::path& CacheWriter::part() const { return state_->part; }

void CacheWriter::keep() {
  seal(part());
  rename_sealed(part(), state_->entry);
  state_->part.clear();
}

bool make_once(const fs::path& entry, const std::function<void(const fs::path& part)>& write,
               const std::function<void()>& while_waiting) {
  if (is_sound(entry)) return false;
  std::unique_ptr<CacheWriter> writer;
  while (!(writer = CacheWriter::begin(entry))) {
    while_waiting();
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  if (!writer->is_needed()) return false;  // the writer we waited for has made it
  write(writer->part());
  writer->keep();
  return true;
}

}  // namespace dipper
