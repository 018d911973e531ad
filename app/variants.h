#pragma once

#include <string>
#include <utility>
#include <vector>

namespace plash {

/// One run of a study: the values of its *PARAMETERs.
struct Variant {
    std::vector<std::pair<std::string, std::string>>
        settings; ///< name and value, in the order of the command line

    /// "MESH=2_SPEED=10": names its directory; "deck" without settings.
    std::string name() const;
    /// The value of a setting; empty when it is not varied.
    std::string value(const std::string& parameter) const;
    /// The same without one setting: what a mesh study holds fixed.
    std::string name_without(const std::string& parameter) const;
};

/// All combinations of `--vary NAME=VALUE,VALUE,...`, the last one varying fastest. Throws
/// std::invalid_argument for text that is not of that form or a name given twice.
std::vector<Variant> variants_of(const std::vector<std::string>& vary);

} // namespace plash
