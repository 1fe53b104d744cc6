// Values as bytes, to the bit: for checkpoints, which the same program reads on the same machine.
#pragma once

#include <cstring>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace dipper::dem {

/// Appends values.
class ByteWriter {
 public:
  template <typename T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  /// For trivial elements, including Eigen's fixed vectors.
  template <typename T>
  void put_all(const std::vector<T>& values) {
    put(values.size());
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Reads them in the same order. Throws std::runtime_error when they end too soon.
class ByteReader {
 public:
  explicit ByteReader(std::string bytes) : bytes_(std::move(bytes)) {}

  template <typename T>
  T get() {
    static_assert(std::is_trivially_copyable_v<T>);
    T value;
    take(&value, sizeof value);
    return value;
  }
  template <typename T>
  std::vector<T> get_all() {
    const auto n = get<std::size_t>();
    if (n > (bytes_.size() - at_) / sizeof(T)) throw std::runtime_error("it is incomplete");
    std::vector<T> values(n);
    take(values.data(), n * sizeof(T));
    return values;
  }

 private:
  void take(void* to, std::size_t size) {
    if (size > bytes_.size() - at_) throw std::runtime_error("it is incomplete");
    std::memcpy(to, bytes_.data() + at_, size);
    at_ += size;
  }
  std::string bytes_;
  std::size_t at_ = 0;
};

}  // namespace dipper::dem
