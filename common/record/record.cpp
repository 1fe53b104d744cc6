#include "common/record/record.hpp"

#include <hdf5.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

namespace dipper::record {
namespace {

/// Rows a chunk: large, so that between flushes only raw data grows and the index stays as it is.
constexpr hsize_t kChunkRows = 4096;

void write_text(hid_t object, const std::string& name, const std::string& text) {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, text.empty() ? 1 : text.size());
  H5Tset_cset(type, H5T_CSET_UTF8);
  const hid_t space = H5Screate(H5S_SCALAR);
  // An attribute holds at most 64 KiB in the compact form all readers know.
  const hid_t attribute = H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT);
  if (attribute >= 0) {
    H5Awrite(attribute, type, text.c_str());
    H5Aclose(attribute);
  }
  H5Sclose(space);
  H5Tclose(type);
}

}  // namespace

void Record::fail(const std::string& what) {
  const int cause = errno;
  broken_ = true;
  throw std::runtime_error("cannot " + what + " " + file_.string() +
                           (cause != 0 ? std::string(": ") + std::strerror(cause) : ""));
}

Record::Record(std::filesystem::path file, const std::map<std::string, std::string>* attributes,
               std::size_t rows)
    : file_(std::move(file)), resumed_(attributes == nullptr), rows_(rows) {
  // Before anything else of HDF5: its exit handler crashes on a file that a full disk left open.
  H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // errors become exceptions, not output
  setenv("HDF5_USE_FILE_LOCKING", "FALSE", 1);  // so that a live run can be looked at
  errno = 0;
  id_ = resumed_ ? H5Fopen(file_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT)
                 : H5Fcreate(file_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  if (id_ < 0) fail(resumed_ ? "open" : "create");
  if (resumed_) return;
  for (const auto& [name, text] : *attributes) write_text(id_, name, text);
}

Record Record::create(const std::filesystem::path& file,
                      const std::map<std::string, std::string>& attributes) {
  return Record(file, &attributes, 0);
}

Record Record::resume(const std::filesystem::path& file, std::size_t rows) {
  return Record(file, nullptr, rows);
}

Record::~Record() {
  if (broken_) return;
  try {
    flush();
  } catch (const std::exception&) {  // the run has reported the cause already
  }
  for (const auto& d : datasets_) H5Dclose(d.id);
  if (id_ >= 0) H5Fclose(id_);
  H5garbage_collect();  // what its exit handler would have freed
}

std::size_t Record::add(const std::string& name, const std::string& unit, const std::string& frame,
                        std::size_t columns) {
  const int rank = columns == 1 ? 1 : 2;
  errno = 0;
  hid_t id = -1;
  if (resumed_) {
    id = H5Dopen2(id_, name.c_str(), H5P_DEFAULT);
    const hsize_t size[2] = {rows_, columns};
    if (id < 0 || H5Dset_extent(id, size) < 0) fail("continue dataset '" + name + "' in");
  } else {
    const hsize_t size[2] = {0, columns};
    const hsize_t limit[2] = {H5S_UNLIMITED, columns};
    const hsize_t chunk[2] = {kChunkRows, columns};
    const hid_t space = H5Screate_simple(rank, size, limit);
    const hid_t layout = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_chunk(layout, rank, chunk);
    const hid_t groups = H5Pcreate(H5P_LINK_CREATE);
    H5Pset_create_intermediate_group(groups, 1);
    id = H5Dcreate2(id_, name.c_str(), H5T_IEEE_F64LE, space, groups, layout, H5P_DEFAULT);
    H5Pclose(groups);
    H5Pclose(layout);
    H5Sclose(space);
    if (id < 0) fail("add dataset '" + name + "' to");
    write_text(id, "unit", unit);
    write_text(id, "frame", frame);
  }
  datasets_.push_back({name, id, columns, std::vector<double>(columns, 0.0), {}});
  return datasets_.size() - 1;
}

void Record::put(std::size_t channel, const double* values) {
  auto& d = datasets_.at(channel);
  d.row.assign(values, values + d.columns);
}

void Record::next() {
  for (auto& d : datasets_) d.buffer.insert(d.buffer.end(), d.row.begin(), d.row.end());
  ++pending_;
}

void Record::flush() {
  if (pending_ == 0) return;
  errno = 0;
  for (auto& d : datasets_) {
    const int rank = d.columns == 1 ? 1 : 2;
    const hsize_t size[2] = {rows_ + pending_, d.columns};
    const hsize_t start[2] = {rows_, 0};
    const hsize_t count[2] = {pending_, d.columns};
    if (H5Dset_extent(d.id, size) < 0) fail("extend dataset '" + d.name + "' in");
    const hid_t file_space = H5Dget_space(d.id);
    H5Sselect_hyperslab(file_space, H5S_SELECT_SET, start, nullptr, count, nullptr);
    const hid_t memory_space = H5Screate_simple(rank, count, nullptr);
    const herr_t status =
        H5Dwrite(d.id, H5T_NATIVE_DOUBLE, memory_space, file_space, H5P_DEFAULT, d.buffer.data());
    H5Sclose(memory_space);
    H5Sclose(file_space);
    if (status < 0) fail("write dataset '" + d.name + "' to");
    d.buffer.clear();
  }
  rows_ += pending_;
  pending_ = 0;
  if (H5Fflush(id_, H5F_SCOPE_GLOBAL) < 0) fail("flush");
}

std::vector<double> read_channel(const std::filesystem::path& file, const std::string& name,
                                 std::size_t column) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t dataset = id < 0 ? -1 : H5Dopen2(id, name.c_str(), H5P_DEFAULT);
  if (dataset < 0) {
    if (id >= 0) H5Fclose(id);
    throw std::runtime_error("cannot read dataset '" + name + "' of " + file.string());
  }
  const hid_t space = H5Dget_space(dataset);
  hsize_t size[2] = {0, 1};
  H5Sget_simple_extent_dims(space, size, nullptr);
  std::vector<double> values(size[0]);
  const hsize_t start[2] = {0, column};
  const hsize_t count[2] = {size[0], 1};
  H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, count, nullptr);
  const hid_t memory = H5Screate_simple(1, size, nullptr);
  const herr_t status =
      size[0] == 0 ? 0
                   : H5Dread(dataset, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, values.data());
  H5Sclose(memory);
  H5Sclose(space);
  H5Dclose(dataset);
  H5Fclose(id);
  if (status < 0)
    throw std::runtime_error("cannot read dataset '" + name + "' of " + file.string());
  return values;
}

std::string read_attribute(const std::filesystem::path& file, const std::string& name) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (id < 0) throw std::runtime_error("cannot open " + file.string());
  std::string text;
  const hid_t attribute = H5Aopen(id, name.c_str(), H5P_DEFAULT);
  if (attribute >= 0) {
    const hid_t type = H5Aget_type(attribute);
    text.resize(H5Tget_size(type));
    if (H5Aread(attribute, type, text.data()) < 0) text.clear();
    text.resize(text.find('\0') == std::string::npos ? text.size() : text.find('\0'));
    H5Tclose(type);
    H5Aclose(attribute);
  }
  H5Fclose(id);
  return text;
}

}  // namespace dipper::record
