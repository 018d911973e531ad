#include "tests/support/lsda_reader.h"

#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace plash::testing {

namespace {

/// A place in the file.
class Cursor {
public:
    Cursor(const std::string& bytes, std::uint64_t at) : bytes_(bytes), at_(at) {}

    std::uint64_t number(std::size_t width)
    {
        std::uint64_t value = 0;
        std::memcpy(&value, text(width).data(), width);
        return value;
    }
    std::string text(std::size_t length)
    {
        if (at_ + length > bytes_.size()) throw std::runtime_error("record beyond the end of the file");
        at_ += length;
        return bytes_.substr(at_ - length, length);
    }

private:
    const std::string& bytes_;
    std::uint64_t at_;
};

} // namespace

std::vector<double> LsdaArray::reals() const
{
    if (type != 10) throw std::runtime_error("no real numbers");
    std::vector<double> values(bytes.size() / 8);
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
}

std::vector<long> LsdaArray::wholes() const
{
    if (type != 4) throw std::runtime_error("no whole numbers");
    std::vector<long> values(bytes.size() / 8);
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
}

std::map<std::string, LsdaArray> read_lsda(const std::string& bytes)
{
    std::map<std::string, LsdaArray> arrays;
    Cursor head(bytes, 0);
    for (int width : {8, 8, 8, 1, 1, 1}) {
        if (head.number(1) != static_cast<unsigned>(width)) throw std::runtime_error("unknown widths");
    }
    head.text(2);
    if (head.number(8) != 17 || head.number(1) != 7) throw std::runtime_error("no place of a table");
    std::uint64_t table = head.number(8);
    std::string folder;
    while (table != 0) {
        Cursor cursor(bytes, table);
        if (cursor.number(8) != 9 || cursor.number(1) != 5)
            throw std::runtime_error("no table where one should be");
        table = 0;
        for (bool open = true; open;) {
            const std::uint64_t content = cursor.number(8) - 9;
            switch (cursor.number(1)) {
            case 2:
                folder = cursor.text(content);
                break;
            case 4: {
                const std::string name = cursor.text(content - 17);
                const int type = static_cast<int>(cursor.number(1));
                const std::uint64_t place = cursor.number(8), count = cursor.number(8);
                const std::size_t width = type == 1 ? 1 : 8;
                Cursor record(bytes, place);
                if (record.number(8) != 11 + name.size() + count * width || record.number(1) != 3)
                    throw std::runtime_error("the record of " + name + " is not where its table says");
                if (record.number(1) != static_cast<unsigned>(type) || record.number(1) != name.size() ||
                    record.text(name.size()) != name)
                    throw std::runtime_error("the record of " + name + " is another one");
                arrays[folder + "/" + name] = {type, record.text(count * width)};
                break;
            }
            case 6:
                table = cursor.number(8);
                open = false;
                break;
            default:
                throw std::runtime_error("unknown command in a table");
            }
        }
    }
    return arrays;
}

} // namespace plash::testing
