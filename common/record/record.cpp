#include "common/record/record.hpp"

#include <hdf5.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "common/input_error.hpp"
#include "common/manifest.hpp"

namespace dipper::record {
namespace {

/// Rows a chunk: large, so that between flushes only raw data grows and the index stays as it is.
constexpr hsize_t kChunkRows = 4096;

Hdf5Handle file_of(hid_t id) { return {id, H5Fclose}; }
Hdf5Handle dataset_of(hid_t id) { return {id, H5Dclose}; }
Hdf5Handle space_of(hid_t id) { return {id, H5Sclose}; }
Hdf5Handle properties_of(hid_t id) { return {id, H5Pclose}; }
Hdf5Handle type_of(hid_t id) { return {id, H5Tclose}; }
Hdf5Handle attribute_of(hid_t id) { return {id, H5Aclose}; }

Hdf5Handle open_to_read(const std::filesystem::path& file) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // errors become exceptions, not output
  setenv("HDF5_USE_FILE_LOCKING", "FALSE", 1);  // a live run's file, or a file system without locks
  auto opened = file_of(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
  if (opened) return opened;
  throw InputError(
      {{file, 0, "",
        std::filesystem::exists(file) ? "cannot be read as a run's record (HDF5)"
                                      : "is missing; a run's folder holds its record there"}});
}

}  // namespace

void Record::fail(const std::string& what) {
  const int cause = errno;
  for (auto& d : datasets_) d.handle.leak();
  handle_.leak();
  throw std::runtime_error("cannot " + what + " " + file_.string() +
                           (cause != 0 ? std::string(": ") + std::strerror(cause) : ""));
}

void Record::write_text(const Hdf5Handle& object, const std::string& name,
                        const std::string& text) {
  errno = 0;
  const auto type = type_of(H5Tcopy(H5T_C_S1));
  const auto space = space_of(H5Screate(H5S_SCALAR));
  if (H5Tset_size(type.id(), text.empty() ? 1 : text.size()) < 0 ||
      H5Tset_cset(type.id(), H5T_CSET_UTF8) < 0)
    fail("write attribute '" + name + "' to");
  const auto attribute = attribute_of(
      H5Acreate2(object.id(), name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT));
  if (!attribute || H5Awrite(attribute.id(), type.id(), text.c_str()) < 0)
    fail("write attribute '" + name + "' (" + std::to_string(text.size()) +
         " bytes; one holds 64 KiB) to");
}

Record::Record(std::filesystem::path file, const std::map<std::string, std::string>* attributes,
               std::size_t rows)
    : file_(std::move(file)), resumed_(attributes == nullptr), rows_(rows) {
  // Before anything else of HDF5: its exit handler crashes on a file that a full disk left open.
  H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // errors become exceptions, not output
  setenv("HDF5_USE_FILE_LOCKING", "FALSE", 1);  // so that a live run can be read
  errno = 0;
  handle_ = file_of(resumed_ ? H5Fopen(file_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT)
                             : H5Fcreate(file_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  if (!handle_) fail(resumed_ ? "open" : "create");
  if (resumed_) return;
  for (const auto& [name, text] : *attributes) write_text(handle_, name, text);
}

Record Record::create(const std::filesystem::path& file,
                      const std::map<std::string, std::string>& attributes) {
  return Record(file, &attributes, 0);
}

Record Record::resume(const std::filesystem::path& file, std::size_t rows) {
  return Record(file, nullptr, rows);
}

Record::~Record() {
  if (!handle_) return;
  try {
    flush();
  } catch (const std::exception&) {  // the run has reported the cause already
  }
  datasets_.clear();
  handle_ = {};
  H5garbage_collect();  // its exit handler would have done so
}

std::size_t Record::add(const std::string& name, const std::string& unit, const std::string& frame,
                        std::size_t columns) {
  const int rank = columns == 1 ? 1 : 2;
  errno = 0;
  Hdf5Handle dataset;
  if (resumed_) {
    dataset = dataset_of(H5Dopen2(handle_.id(), name.c_str(), H5P_DEFAULT));
    if (!dataset) fail("continue dataset '" + name + "' in");
    hsize_t held[2] = {0, 0};
    const hsize_t size[2] = {rows_, columns};
    if (H5Sget_simple_extent_dims(space_of(H5Dget_space(dataset.id())).id(), held, nullptr) != rank)
      fail("read the size of '" + name + "' in");
    if (held[0] < rows_)  // to extend it would fill it with zeros
      throw InputError(
          {{file_, 0, name,
            "has " + std::to_string(held[0]) + " rows, the checkpoint " + std::to_string(rows_) +
                "; remove this checkpoint, to continue from "
                "the one before it"}});
    if (H5Dset_extent(dataset.id(), size) < 0) fail("continue dataset '" + name + "' in");
  } else {
    const hsize_t size[2] = {0, columns};
    const hsize_t limit[2] = {H5S_UNLIMITED, columns};
    const hsize_t chunk[2] = {kChunkRows, columns};
    const auto space = space_of(H5Screate_simple(rank, size, limit));
    const auto layout = properties_of(H5Pcreate(H5P_DATASET_CREATE));
    const auto groups = properties_of(H5Pcreate(H5P_LINK_CREATE));
    if (H5Pset_chunk(layout.id(), rank, chunk) < 0 ||
        H5Pset_create_intermediate_group(groups.id(), 1) < 0)
      fail("add dataset '" + name + "' to");
    dataset = dataset_of(H5Dcreate2(handle_.id(), name.c_str(), H5T_IEEE_F64LE, space.id(),
                                    groups.id(), layout.id(), H5P_DEFAULT));
    if (!dataset) fail("add dataset '" + name + "' to");
    write_text(dataset, "unit", unit);
    write_text(dataset, "frame", frame);
  }
  datasets_.push_back({name, std::move(dataset), columns, std::vector<double>(columns, 0.0), {}});
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
    if (H5Dset_extent(d.handle.id(), size) < 0) fail("extend dataset '" + d.name + "' in");
    const auto file_space = space_of(H5Dget_space(d.handle.id()));
    const auto memory_space = space_of(H5Screate_simple(rank, count, nullptr));
    if (H5Sselect_hyperslab(file_space.id(), H5S_SELECT_SET, start, nullptr, count, nullptr) < 0 ||
        H5Dwrite(d.handle.id(), H5T_NATIVE_DOUBLE, memory_space.id(), file_space.id(), H5P_DEFAULT,
                 d.buffer.data()) < 0)
      fail("write dataset '" + d.name + "' to");
    d.buffer.clear();
  }
  rows_ += pending_;
  pending_ = 0;
  if (H5Fflush(handle_.id(), H5F_SCOPE_GLOBAL) < 0) fail("flush");
}

void Record::sync() {
  flush();
  dipper::sync(file_);
}

std::vector<double> read_channel(const std::filesystem::path& file, const std::string& name,
                                 std::size_t column) {
  const auto refuse = [&](const std::string& why) { return InputError({{file, 0, name, why}}); };
  const auto opened = open_to_read(file);
  const auto dataset = dataset_of(H5Dopen2(opened.id(), name.c_str(), H5P_DEFAULT));
  if (!dataset) throw refuse("no such dataset");
  const auto space = space_of(H5Dget_space(dataset.id()));
  const int rank = H5Sget_simple_extent_ndims(space.id());
  hsize_t size[2] = {0, 1};
  if (rank < 1 || rank > 2 || H5Sget_simple_extent_dims(space.id(), size, nullptr) < 0)
    throw refuse("not a table of rows and columns");
  if (column >= size[1])
    throw refuse("has no column " + std::to_string(column) + ", only " + std::to_string(size[1]));
  if (size[0] > std::filesystem::file_size(file))
    throw refuse(std::to_string(size[0]) + " rows are more than the file has bytes");
  std::vector<double> values(size[0]);
  if (values.empty()) return values;
  const hsize_t start[2] = {0, column};
  const hsize_t count[2] = {size[0], 1};
  const auto memory = space_of(H5Screate_simple(1, size, nullptr));
  if (H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, start, nullptr, count, nullptr) < 0 ||
      H5Dread(dataset.id(), H5T_NATIVE_DOUBLE, memory.id(), space.id(), H5P_DEFAULT,
              values.data()) < 0)
    throw refuse("cannot be read");
  return values;
}

std::string read_attribute(const std::filesystem::path& file, const std::string& name) {
  const auto opened = open_to_read(file);
  if (H5Aexists(opened.id(), name.c_str()) <= 0) return "";
  const auto attribute = attribute_of(H5Aopen(opened.id(), name.c_str(), H5P_DEFAULT));
  const auto type = type_of(attribute ? H5Aget_type(attribute.id()) : -1);
  const auto space = space_of(attribute ? H5Aget_space(attribute.id()) : -1);
  // One text of fixed length: of any other kind HDF5 would write more than there is room for.
  const bool is_text = type && space && H5Tget_class(type.id()) == H5T_STRING &&
                       H5Tis_variable_str(type.id()) == 0 &&
                       H5Sget_simple_extent_npoints(space.id()) == 1;
  std::string text(is_text ? H5Tget_size(type.id()) : 0, '\0');
  if (!is_text || H5Aread(attribute.id(), type.id(), text.data()) < 0)
    throw InputError({{file, 0, name, "cannot be read as a string"}});
  return text.substr(0, text.find('\0'));
}

}  // namespace dipper::record
