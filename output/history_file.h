#pragma once

#include "output/array_file.h"
#include "output/result_file.h"

#include <map>
#include <vector>

namespace plash {

/// history.h5: the histories of binout's folders as HDF5 arrays, one row a state (layout in docs/output.md):
/// what binout has as /nodout/d000001/x_velocity, d000002 ... is one array /nodout/x_velocity [states x
/// nodes]. Rows that have become shorter (eroded elements) are filled up with not-a-number and -1.
///
/// The file is kept in memory and written anew, beside its name and then moved there, whenever it has grown
/// by a tenth, so that a reader always finds a whole file; histories are small.
class HistoryFile final : public ArrayFile {
public:
    explicit HistoryFile(const ResultPath& path);

    void folder(const std::string& path) override;
    void put(std::string_view name, std::span<const double> values) override;
    void put(std::string_view name, std::span<const Id> values) override;
    void put(std::string_view name, std::string_view text) override;
    void commit() override;
    void close() override { write(); }
    void serialise(Archive& archive) override;

private:
    struct Array {
        std::size_t width = 0; ///< values a row
        std::vector<double> numbers;
        std::vector<Id> wholes;
        std::string text;
        bool per_state = false; ///< rows are states

        void serialise(Archive& archive) { archive(width, numbers, wholes, text, per_state); }
    };
    std::string path_;
    std::string group_;
    bool in_state_ = false;
    std::map<std::string, Array> arrays_; ///< by whole path
    std::size_t bytes_ = 0, written_bytes_ = 0;

    Array& array(std::string_view name, std::size_t width);
    void write();
};

} // namespace plash
