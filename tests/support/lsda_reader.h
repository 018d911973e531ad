#pragma once

#include <map>
#include <string>
#include <vector>

namespace plash::testing {

/// One array of a binout (LSDA) file.
struct LsdaArray {
    int type = 0; ///< 1 bytes, 4 whole numbers of eight bytes, 10 real numbers of eight bytes
    std::string bytes;

    std::vector<double> reals() const;
    std::vector<long> wholes() const;
};

/// All arrays by their whole path, as the tables of the file list them; written from the format's description
/// and independent of the writer. Throws std::runtime_error where the file is not well formed.
std::map<std::string, LsdaArray> read_lsda(const std::string& bytes);

} // namespace plash::testing
