// An HDF5 object that has to be closed, without HDF5's header.
#pragma once

#include <cstdint>
#include <utility>

namespace dipper::record {

/// Owns a hid_t and closes it with the function that belongs to its kind (H5Fclose, H5Dclose, ...).
/// Null when HDF5 could not give it.
class Hdf5Handle {
 public:
  using Close = int (*)(std::int64_t);

  Hdf5Handle() = default;
  Hdf5Handle(std::int64_t id, Close close) : id_(id), close_(close) {}
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(other.leak()), close_(other.close_) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Hdf5Handle() {
    if (*this) close_(id_);
  }

  explicit operator bool() const { return id_ >= 0; }
  std::int64_t id() const { return id_; }

  /// Releases it without closing it: HDF5 crashes when a file that a full disk left half written is
  /// closed.
  std::int64_t leak() { return std::exchange(id_, -1); }

 private:
  std::int64_t id_ = -1;
  Close close_ = nullptr;
};

}  // namespace dipper::record
