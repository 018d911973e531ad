#include "materials/blatz_ko.h"

namespace plash {

BlatzKo BlatzKo::from_record(const Record& record, const Model&)
{
    BlatzKo rubber;
    rubber.density = positive(record, "RO", "mass density");
    rubber.shear_modulus = positive(record, "G", "shear modulus");
    if (record.real("REF") != 0) {
        reject_field(record, "REF", "a reference geometry is not supported; leave the field at 0");
    }
    return rubber;
}

} // namespace plash
