#include "output/history_file.h"

#include "core/run_error.h"

#include <cstdio>
#include <fmt/format.h>
#include <hdf5.h>
#include <limits>

namespace plash {

namespace {

/// An HDF5 handle that is closed by its own kind of close.
class Handle {
public:
    Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
    ~Handle()
    {
        if (id_ >= 0) close_(id_);
    }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;

    operator hid_t() const { return id_; }

private:
    hid_t id_;
    herr_t (*close_)(hid_t);
};

/// A folder name of binout without its state ("/nodout/d000012" -> "/nodout"); says whether there was one.
bool cut_state(std::string& path)
{
    const std::size_t slash = path.rfind('/');
    const std::string last = path.substr(slash + 1);
    if (last == "metadata") {
        path.resize(slash);
        return false;
    }
    const bool state =
        last.size() > 1 && last[0] == 'd' && last.find_first_not_of("0123456789", 1) == std::string::npos;
    if (state) path.resize(slash);
    return state;
}

} // namespace

HistoryFile::HistoryFile(const ResultPath& path) : path_(path.path) {}

void HistoryFile::folder(const std::string& path)
{
    group_ = path;
    in_state_ = cut_state(group_);
}

HistoryFile::Array& HistoryFile::array(std::string_view name, std::size_t width)
{
    Array& array = arrays_[group_ + "/" + std::string(name)];
    if (array.width == 0) array.width = width;
    array.per_state = in_state_;
    return array;
}

void HistoryFile::put(std::string_view name, std::span<const double> values)
{
    Array& target = array(name, values.size());
    target.numbers.insert(target.numbers.end(), values.begin(), values.end());
    const std::size_t missing = target.width > values.size() ? target.width - values.size() : 0;
    target.numbers.resize(target.numbers.size() + missing, std::numeric_limits<double>::quiet_NaN());
    bytes_ += 8 * target.width;
}

void HistoryFile::put(std::string_view name, std::span<const Id> values)
{
    Array& target = array(name, values.size());
    target.wholes.insert(target.wholes.end(), values.begin(), values.end());
    const std::size_t missing = target.width > values.size() ? target.width - values.size() : 0;
    target.wholes.resize(target.wholes.size() + missing, -1);
    bytes_ += 8 * target.width;
}

void HistoryFile::put(std::string_view name, std::string_view text)
{
    array(name, text.size()).text = text;
}

void HistoryFile::commit()
{
    if (10 * (bytes_ - written_bytes_) > bytes_) write();
}

void HistoryFile::write()
{
    const std::string next = path_ + ".new";
    {
        const Handle file(H5Fcreate(next.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
        const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
        H5Pset_create_intermediate_group(links, 1);
        const Handle plain(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
        H5Pset_obj_track_times(plain, false); // the same run gives the same bytes
        bool good = file >= 0;
        for (const auto& [path, array] : arrays_) {
            if (array.width == 0) continue;
            const bool text = !array.text.empty(), numbers = !array.numbers.empty();
            const hsize_t rows = (numbers ? array.numbers.size() : array.wholes.size()) / array.width;
            const hsize_t shape[2] = {rows, array.width};
            const Handle string(H5Tcopy(H5T_C_S1), H5Tclose);
            if (text) H5Tset_size(string, array.text.size());
            // Times and other single numbers are vectors over the states; constants are vectors of entries.
            const int rank = array.per_state && array.width > 1 ? 2 : 1;
            const hsize_t* extent = array.per_state ? shape : shape + 1;
            const Handle space(text ? H5Screate(H5S_SCALAR) : H5Screate_simple(rank, extent, nullptr),
                               H5Sclose);
            const hid_t type = text ? hid_t{string} : numbers ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT64;
            const Handle set(H5Dcreate2(file, path.c_str(), type, space, links, plain, H5P_DEFAULT),
                             H5Dclose);
            const void* data = text      ? static_cast<const void*>(array.text.data())
                               : numbers ? static_cast<const void*>(array.numbers.data())
                                         : static_cast<const void*>(array.wholes.data());
            good = good && set >= 0 && H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0;
        }
        good = good && H5Fflush(file, H5F_SCOPE_GLOBAL) >= 0;
        if (!good) throw RunError(fmt::format("result file {} cannot be written", path_));
    }
    if (std::rename(next.c_str(), path_.c_str()) != 0)
        throw RunError(fmt::format("result file {} cannot be replaced", path_));
    written_bytes_ = bytes_;
}

void HistoryFile::serialise(Archive& archive)
{
    std::size_t count = arrays_.size();
    archive(count, bytes_);
    if (!archive.loading()) {
        for (auto& [path, array] : arrays_) {
            std::string name = path;
            archive(name, array);
        }
        return;
    }
    arrays_.clear();
    for (std::size_t i = 0; i < count; ++i) {
        std::string name;
        archive(name);
        archive(arrays_[name]);
    }
    written_bytes_ = 0;
}

} // namespace plash
