#include "contact/pair_search.h"
#include "core/parallel.h"

namespace plash {

namespace {

/// Blocks of nodes beyond which a cell is taken to have to do with all nodes.
constexpr std::size_t most_blocks = 128;

/// Remembers what has been seen since the last clear().
class Seen {
public:
    explicit Seen(std::size_t count) : stamp_(count, 0) {}
    void clear() { ++now_; }
    /// Whether it is seen for the first time.
    bool first(std::size_t item)
    {
        if (stamp_[item] == now_) return false;
        stamp_[item] = now_;
        return true;
    }

private:
    std::vector<Index> stamp_;
    Index now_ = 0;
};

} // namespace

void PathCells::set(const ContactMesh& mesh, std::span<const Index> owner, std::span<const Index> begin,
                    std::span<const Index> facet)
{
    const std::size_t cells = (owner.size() + owners_at_once - 1) / owners_at_once;
    travelled_.assign(cells, 0);
    step_range_.assign(cells, 0);
    begin_.assign(1, 0);
    block_.clear();
    Seen facets(mesh.facets.size()), nodes(mesh.nodes.size()), around(mesh.facets.size()),
        blocks(mesh.nodes.size() / ContactMotion::block_length + 1);
    for (std::size_t cell = 0; cell < cells; ++cell) {
        const std::size_t first = cell * owners_at_once;
        const std::size_t last = std::min(first + owners_at_once, owner.size());
        for (Seen* seen : {&facets, &nodes, &around, &blocks}) seen->clear();
        const auto take = [&](Index node) {
            const std::size_t block = node / ContactMotion::block_length;
            if (blocks.first(block)) block_.push_back(static_cast<Index>(block));
        };
        const auto take_around = [&](Index corner) {
            if (!nodes.first(corner)) return;
            for (Index other : mesh.facets_at_node(corner))
                if (around.first(other))
                    for (Index node : mesh.facets[other].corner) take(node);
        };
        for (std::size_t i = first; i < last; ++i) take(owner[i]);
        for (Index pair = begin[first]; pair < begin[last]; ++pair) {
            if (block_.size() - begin_.back() > most_blocks) break;
            if (!facets.first(facet[pair])) continue;
            for (Index corner : mesh.facets[facet[pair]].corner) take_around(corner);
        }
        if (block_.size() - begin_.back() > most_blocks) block_.resize(begin_.back());
        begin_.push_back(static_cast<Index>(block_.size()));
    }
}

void PathCells::advance(const ContactMotion& motion)
{
    for_chunks(travelled_.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t cell = first; cell < last; ++cell) {
            step_range_[cell] = motion.step_range;
            if (begin_[cell] < begin_[cell + 1] && !motion.block_range.empty()) {
                Bounds range;
                for (Index i = begin_[cell]; i < begin_[cell + 1]; ++i)
                    range.add(motion.block_range[block_[i]]);
                step_range_[cell] = norm(range.high - range.low) * motion.last_step;
            }
            travelled_[cell] += step_range_[cell];
        }
    });
}

} // namespace plash
