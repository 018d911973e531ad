#pragma once

#include "output/array_file.h"
#include "output/result_file.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace plash {

/// A binout file (LSDA): named arrays in folders, with tables that say where each array stands. The layout is
/// the one that public readers (lasso-python, qd) expect: a header of eight bytes with the widths used,
/// records of length, command and content; every table ends with the place of the next.
///
/// Arrays are collected and written together: first all arrays and their table behind what is there, then the
/// place of the table into the end of the last one. Whoever reads the file at any moment sees whole states.
class LsdaFile final : public ArrayFile {
public:
    explicit LsdaFile(const ResultPath& path);

    void folder(const std::string& path) override { folder_ = path; }
    void put(std::string_view name, std::span<const double> values) override;
    void put(std::string_view name, std::span<const Id> values) override; ///< as eight-byte whole numbers
    void put(std::string_view name, std::string_view text) override;
    void commit() override;
    void serialise(Archive& archive) override;

private:
    struct Entry {
        std::string folder, name;
        std::uint8_t type;
        std::uint64_t offset; ///< of its record, from the beginning of `records_`
        std::uint64_t count;
    };
    ResultFile file_;
    std::string folder_;
    std::string records_;           ///< arrays that wait to be written
    std::string folder_of_records_; ///< that the last of them stands in
    std::vector<Entry> entries_;
    std::uint64_t length_ = 0; ///< of the file so far [byte]
    std::uint64_t link_ = 0;   ///< where the place of the next table goes [byte]

    void put_record(std::string_view name, std::uint8_t type, const void* data, std::uint64_t count,
                    std::size_t width);
};

} // namespace plash
