#include "output/lsda_file.h"

#include <bit>
#include <cstring>

namespace plash {

namespace {

static_assert(std::endian::native == std::endian::little,
              "binout files are written with the machine's bytes");

enum Command : std::uint8_t {
    change_folder = 2,
    data = 3,
    variable = 4,
    begin_table = 5,
    end_table = 6,
    table_place = 7
};

enum Type : std::uint8_t { bytes = 1, whole64 = 4, real64 = 10 };

void append_number(std::string& text, std::uint64_t value, std::size_t width = 8)
{
    text.append(reinterpret_cast<const char*>(&value), width);
}

/// Length and command of a record whose content has `content` bytes.
void append_head(std::string& text, Command command, std::size_t content)
{
    append_number(text, 9 + content);
    append_number(text, command, 1);
}

} // namespace

LsdaFile::LsdaFile(const ResultPath& path) : file_(path)
{
    std::string head;
    for (int width : {8, 8, 8, 1, 1, 1, 0, 0}) append_number(head, width, 1); // 1: low byte first
    append_head(head, table_place, 8);
    link_ = head.size();
    append_number(head, 0);
    length_ = head.size();
    file_.write(head);
    file_.flush();
}

void LsdaFile::put_record(std::string_view name, std::uint8_t type, const void* values, std::uint64_t count,
                          std::size_t width)
{
    if (folder_ != folder_of_records_) { // for readers that walk the records and leave the tables alone
        append_head(records_, change_folder, folder_.size());
        records_ += folder_;
        folder_of_records_ = folder_;
    }
    entries_.push_back({folder_, std::string(name), type, records_.size(), count});
    append_head(records_, data, 2 + name.size() + count * width);
    append_number(records_, type, 1);
    append_number(records_, name.size(), 1);
    records_ += name;
    records_.append(static_cast<const char*>(values), count * width);
}

void LsdaFile::put(std::string_view name, std::span<const double> values)
{
    put_record(name, real64, values.data(), values.size(), sizeof(double));
}

void LsdaFile::put(std::string_view name, std::span<const Id> values)
{
    put_record(name, whole64, values.data(), values.size(), sizeof(Id));
}

void LsdaFile::put(std::string_view name, std::string_view text)
{
    put_record(name, bytes, text.data(), text.size(), 1);
}

void LsdaFile::commit()
{
    if (entries_.empty()) return;
    std::string table;
    append_head(table, begin_table, 0);
    std::string_view folder;
    for (const Entry& entry : entries_) {
        if (entry.folder != folder) {
            append_head(table, change_folder, entry.folder.size());
            table += entry.folder;
            folder = entry.folder;
        }
        append_head(table, variable, entry.name.size() + 17);
        table += entry.name;
        append_number(table, entry.type, 1);
        append_number(table, length_ + entry.offset);
        append_number(table, entry.count);
    }
    append_head(table, end_table, 8);
    const std::uint64_t place = length_ + records_.size();
    const std::uint64_t next_link = place + table.size();
    append_number(table, 0);
    file_.write(records_);
    file_.write(table);
    file_.flush();
    file_.overwrite(link_, std::string_view(reinterpret_cast<const char*>(&place), sizeof place));
    link_ = next_link;
    length_ = next_link + 8;
    records_.clear();
    entries_.clear();
    folder_of_records_.clear();
}

void LsdaFile::serialise(Archive& archive)
{
    const std::uint64_t head_length = length_;
    archive(file_, link_, length_);
    if (!archive.loading()) return;
    if (file_.length() != length_) { // the file had gone and begins anew
        length_ = head_length;
        link_ = head_length - 8;
        return;
    }
    const std::uint64_t nothing = 0;
    file_.overwrite(link_, std::string_view(reinterpret_cast<const char*>(&nothing), sizeof nothing));
}

} // namespace plash
