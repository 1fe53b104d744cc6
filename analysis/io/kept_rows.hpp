// Rows of text frames in memory: a report reads each frame about twelve times.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "analysis/io/dump_reader.hpp"

namespace dipper::analysis::io {

/// A word in place of a number.
struct BadWord {
  long line = 0;  ///< 0: none
  std::string word;
};

/// All of a frame, in the order of the file.
struct FrameRows {
  std::vector<std::vector<double>> columns;  ///< as DumpFrame::columns names them
  std::vector<BadWord> bad;                  ///< the first of each column
};

/// The frames that one reader has read: it keeps the first ones until they fill `kept_bytes`, and
/// of the others the last. A frame above `frame_bytes` is never kept, so memory is bounded for any
/// dump.
class KeptRows {
 public:
  explicit KeptRows(std::size_t kept_bytes = 512 << 20, std::size_t frame_bytes = 128 << 20)
      : left_bytes_(kept_bytes), frame_bytes_(frame_bytes) {}

  /// `read` fills the rows of a frame that is not kept. Null: too large to keep. Valid until the
  /// next call. Not thread-safe.
  template <class Read>
  const FrameRows* rows(const DumpFrame& frame, const Read& read) {
    const std::size_t bytes = frame.particles * frame.columns.size() * sizeof(double);
    if (bytes > frame_bytes_) return nullptr;
    const Key key(frame.file, frame.offset);
    if (const auto at = kept_.find(key); at != kept_.end()) return &at->second;
    if (key == last_key_) return &last_;
    FrameRows fresh = read();
    if (bytes <= left_bytes_) {
      left_bytes_ -= bytes;
      return &(kept_[key] = std::move(fresh));
    }
    last_key_ = key;
    return &(last_ = std::move(fresh));
  }

 private:
  using Key = std::tuple<std::string, std::int64_t>;  // file, offset
  std::size_t left_bytes_, frame_bytes_;
  std::map<Key, FrameRows> kept_;
  Key last_key_;
  FrameRows last_;
};

}  // namespace dipper::analysis::io
