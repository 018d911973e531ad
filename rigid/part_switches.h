#pragma once

#include "core/archive.h"
#include "core/state.h"
#include "model/model.h"
#include "rigid/rigid_body.h"

#include <functional>
#include <vector>

namespace plash {

/// *DEFORMABLE_TO_RIGID_AUTOMATIC: makes parts rigid and sets others free once its time has come, or when a
/// wall or contact presses or does not. A switch without a partner acts once; of a pair the master (PAIRED =
/// 1) acts first, then the other, and so on in turns.
struct PartSwitch {
    enum class Code { time, wall_free, contact_free, wall_pressed, contact_pressed };
    Id id = 0;
    Code code = Code::time;
    double from = 0, to = forever;      ///< TIME1, TIME2 [time]
    double delay = 0;                   ///< TIME3: no switch acts for so long after this one [time]
    Id watched = 0;                     ///< ENTNO: the wall or contact, by its id or its place in the deck
    Index partner = none;               ///< position of RELSW in the list
    std::vector<Index> engage, release; ///< positions in the list of bodies
    Location where;
    std::function<bool()> pressed; ///< whether the wall or contact does; set by whoever knows them

    bool ready = true; ///< may act
};

/// All switches of a deck, with the bodies that they make.
class PartSwitches {
public:
    bool empty() const { return switches_.empty(); }
    std::vector<PartSwitch>& all() { return switches_; }
    /// The bodies, positions in the list of bodies.
    const std::vector<Index>& bodies() const { return bodies_; }
    /// The elements of a part have had no stress yet: it has been rigid since the start.
    bool at_rest(Index part) const { return at_rest_[part] != 0; }
    /// The parts of a body may have stresses from now on.
    void wake(Index body);

    /// Adds the bodies of the switches to those of the scene; bodies that *DEFORMABLE_TO_RIGID makes and a
    /// switch sets free are rigid from the start. DeckError for parts that cannot be switched: held or driven
    /// nodes, nodes without mass or of other bodies.
    static PartSwitches read(const Model& model, const State& state, std::vector<RigidBody>& bodies);

    /// Switches that act at a time, in the order of the deck.
    std::vector<const PartSwitch*> act(double time);

    void serialise(Archive& archive);

private:
    std::vector<PartSwitch> switches_;
    std::vector<Index> bodies_;
    std::vector<std::vector<Index>> parts_; ///< of each of these
    std::vector<std::uint8_t> at_rest_;     ///< by part of the Model
    double waits_until_ = 0;                ///< TIME3 of the last one that has acted [time]
};

} // namespace plash
