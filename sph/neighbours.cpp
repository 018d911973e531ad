#include "sph/neighbours.h"

#include "core/run_error.h"
#include "math/aligned.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <fmt/format.h>
#include <numeric>

namespace plash {

namespace {

/// Distances are looked at in single precision, in sixteen lanes.
using Floats = float [[gnu::vector_size(64)]];
constexpr int float_count = 16;

/// Particles around one cell in contiguous arrays, in rising order of cells, with room to read a batch past
/// the end. Positions count from somewhere in the cell, so that single precision tells them apart.
struct Candidates {
    Vec3 origin;
    using AlignedFloats = std::vector<float, CacheAligned<float>>;
    AlignedFloats x, y, z, reach;
    std::vector<Index> name; ///< what lists call it: an offset in the run, or a slot of the halo
    std::size_t count = 0;

    void clear(const Vec3& new_origin)
    {
        origin = new_origin;
        count = 0;
    }
    /// Before some more are added.
    void make_room(std::size_t more)
    {
        const std::size_t room = count + more + float_count;
        if (room <= name.size()) return;
        for (auto* values : {&x, &y, &z, &reach}) values->resize(2 * room);
        name.resize(2 * room);
    }
    /// The places first .. last - 1, by names that follow one another.
    void add(const SearchInput& input, Index first, Index last, Index first_name)
    {
        if (first >= last) return;
        make_room(static_cast<std::size_t>(last - first));
        float *to_x = x.data() + count, *to_y = y.data() + count, *to_z = z.data() + count;
        for (Index p = first; p < last; ++p) {
            const Vec3 offset = input.motion[p].position - origin;
            to_x[p - first] = static_cast<float>(offset.x);
            to_y[p - first] = static_cast<float>(offset.y);
            to_z[p - first] = static_cast<float>(offset.z);
        }
        std::copy_n(input.reach.data() + first, last - first, reach.data() + count);
        std::iota(name.data() + count, name.data() + count + (last - first), first_name);
        count += static_cast<std::size_t>(last - first);
    }
    void add(const Candidates& other, std::size_t i)
    {
        x[count] = other.x[i];
        y[count] = other.y[i];
        z[count] = other.z[i];
        reach[count] = other.reach[i];
        name[count++] = other.name[i];
    }
    /// First candidate whose name is not below this one; of candidates in rising order.
    std::size_t first_from(Index wanted) const
    {
        return std::lower_bound(name.begin(), name.begin() + static_cast<std::ptrdiff_t>(count), wanted) -
               name.begin();
    }
};

/// Numbers the places of a run's halo in the order in which they are first asked for. All that a cell holds
/// gets slots side by side when the cell is first met, so that nobody has to be looked up one by one.
class HaloNumbers {
public:
    void clear(Index cell_count)
    {
        for (Index cell : met_) first_slot_[cell] = none;
        met_.clear();
        slots_.clear();
        places_.clear();
        first_slot_.resize(static_cast<std::size_t>(cell_count), none);
    }
    const std::vector<Index>& places() const { return places_; }

    /// The slot of the first particle of a cell; the others follow, then its copies.
    Index first_slot(const ParticleCells& cells, Index cell)
    {
        Index& first = first_slot_[cell];
        if (first != none) return first;
        first = static_cast<Index>(slots_.size());
        met_.push_back(cell);
        for (Index p = cells.begin(cell); p < cells.end(cell); ++p) slots_.push_back({p, none});
        for (Index p = cells.first_copy(cell); p < cells.first_copy(cell + 1); ++p)
            slots_.push_back({p, none});
        return first;
    }
    Index place_of(Index slot) const { return slots_[slot].place; }

    /// The number of what has a slot, cut to 16 bits: meaningless once there are more.
    std::uint16_t number_of(Index slot)
    {
        Slot& at = slots_[slot];
        if (at.number == none) {
            at.number = static_cast<Index>(places_.size());
            places_.push_back(at.place);
        }
        return static_cast<std::uint16_t>(at.number);
    }

private:
    struct Slot {
        Index place, number;
    };
    std::vector<Index> first_slot_; ///< by cell; none: not met yet
    std::vector<Index> met_;        ///< cells
    std::vector<Slot> slots_;
    std::vector<Index> places_;
};

/// Pairs of a run that wait for the second of their particles to be listed, with it.
class HandedOver {
public:
    void clear(Index particles)
    {
        last_.assign(particles, none);
        pairs_.clear();
    }
    void add(Index to, Index from)
    {
        pairs_.push_back({from, last_[to]});
        last_[to] = static_cast<Index>(pairs_.size()) - 1;
    }
    /// Calls take(from) for all that were handed over to a particle.
    template <class Take>
    void for_each(Index to, Take&& take) const
    {
        for (Index pair = last_[to]; pair != none; pair = pairs_[pair].before) take(pairs_[pair].from);
    }

private:
    struct Pair {
        Index from, before;
    };
    std::vector<Index> last_; ///< by particle of the run: the last pair handed over to it
    std::vector<Pair> pairs_;
};

/// What one thread works with.
struct Scratch {
    Candidates inside;                    ///< of the run, and awake: in rising order
    Candidates outside;                   ///< all others
    Candidates cell_inside, cell_outside; ///< the same of a whole cell, where these are of a part of it
    std::vector<Index> found;             ///< names of candidates
    std::vector<std::uint16_t> inside_list;
    std::vector<std::uint16_t> outside_list;
    HaloNumbers halo;
    HandedOver handed_over;
};

Floats load(const float* values)
{
    Floats lanes;
    std::memcpy(&lanes, values, sizeof lanes);
    return lanes;
}

/// Bits of the lanes where a < b.
unsigned bits_below(Floats a, Floats b)
{
#if defined(__AVX512F__)
    return _mm512_cmp_ps_mask(reinterpret_cast<__m512>(a), reinterpret_cast<__m512>(b), _CMP_LT_OQ);
#else
    unsigned bits = 0;
    for (int lane = 0; lane < float_count; ++lane) bits |= static_cast<unsigned>(a[lane] < b[lane]) << lane;
    return bits;
#endif
}

/// Writes the values of the lanes that are set one after another, and returns the new end.
Index* append_set(unsigned bits, const Index* values, Index* end)
{
#if defined(__AVX512F__)
    _mm512_storeu_si512(
        end, _mm512_maskz_compress_epi32(static_cast<__mmask16>(bits), _mm512_loadu_si512(values)));
    return end + std::popcount(bits);
#else
    for (; bits != 0; bits &= bits - 1) *end++ = values[std::countr_zero(bits)];
    return end;
#endif
}

/// A particle as the candidates of its cell see it.
struct Seeker {
    float x, y, z, reach;
};

/// Bits of the candidates of the batch at c that something reaches whose components are this far from them.
unsigned reached(const Candidates& candidates, std::size_t c, Floats x, Floats y, Floats z, float reach)
{
    const Floats limit = load(&candidates.reach[c]) + reach;
    const unsigned bits = bits_below(x * x + y * y + z * z, limit * limit);
    return candidates.count - c < float_count ? bits & ((1u << (candidates.count - c)) - 1) : bits;
}

/// Writes the names of the candidates from `first` on that a particle reaches to `found`; returns the end.
Index* find_close(const Candidates& candidates, std::size_t first, const Seeker& seeker, Index* found)
{
    // Whole batches stand on cache lines; the first one is cut.
    std::size_t c = first & ~std::size_t(float_count - 1);
    for (unsigned cut = ~0u << (first - c); c < candidates.count; c += float_count, cut = ~0u) {
        const unsigned bits =
            reached(candidates, c, load(&candidates.x[c]) - seeker.x, load(&candidates.y[c]) - seeker.y,
                    load(&candidates.z[c]) - seeker.z, seeker.reach);
        found = append_set(bits & cut, &candidates.name[c], found);
    }
    return found;
}

/// Those of `all` whose reach, with `reach`, comes to a box.
void take_near(const Candidates& all, const Vector3<float>& lower, const Vector3<float>& upper, float reach,
               Candidates& near)
{
    const auto beyond = [](const float* x, float low, float high) {
        const Floats at = load(x), zero{};
        const Floats below = low - at, above = at - high;
        const Floats more = below > above ? below : above;
        return more > zero ? more : zero;
    };
    near.clear(all.origin);
    near.make_room(all.count);
    for (std::size_t c = 0; c < all.count; c += float_count) {
        unsigned bits =
            reached(all, c, beyond(&all.x[c], lower.x, upper.x), beyond(&all.y[c], lower.y, upper.y),
                    beyond(&all.z[c], lower.z, upper.z), reach);
        for (; bits != 0; bits &= bits - 1) near.add(all, c + std::countr_zero(bits));
    }
}

/// Takes those of a list that p's group does not see out of it: place(entry) tells who they are. Returns the
/// new end.
template <class Place>
Index* drop_unseen(const SearchInput& input, Index p, Index* begin, Index* end, Place&& place)
{
    if (input.sees.empty()) return end;
    const std::uint64_t seen = input.sees[input.group[p]];
    return std::remove_if(begin, end, [&](Index other) { return !(seen >> input.group[place(other)] & 1); });
}

class RunBuilder {
public:
    RunBuilder(const ParticleCells& cells, const SearchInput& input, NeighbourRun& run, Scratch& scratch)
        : cells_(cells),
          input_(input),
          run_(run),
          scratch_(scratch),
          anyone_asleep_(!input.asleep.empty() &&
                         std::any_of(input.asleep.begin() + run.begin, input.asleep.begin() + run.end,
                                     [](std::uint8_t asleep) { return asleep != 0; }))
    {}

    /// False when the halo has more places than it may have.
    bool build(std::size_t largest_halo)
    {
        run_.counts.assign(run_.length(), {});
        scratch_.inside_list.clear();
        scratch_.outside_list.clear();
        scratch_.halo.clear(cells_.cell_count());
        scratch_.handed_over.clear(run_.length());
        for (Index cell = cells_.cell_of_place(run_.begin);
             cell < cells_.cell_count() && cells_.begin(cell) < run_.end; ++cell) {
            const Index first = std::max(run_.begin, cells_.begin(cell));
            const Index last = std::min(run_.end, cells_.end(cell));
            if (first >= last) continue; // images alone
            collect_candidates(cell, input_.motion[first].position);
            if (scratch_.inside.count + scratch_.outside.count <= many_candidates) {
                list_all(first, last);
                continue;
            }
            std::swap(scratch_.inside, scratch_.cell_inside);
            std::swap(scratch_.outside, scratch_.cell_outside);
            for (Index begin = first; begin < last; begin += group_length) {
                const Index end = std::min(begin + group_length, last);
                narrow_candidates(begin, end);
                list_all(begin, end);
            }
        }
        // Exact sizes: the lists are most of what a particle costs in memory.
        run_.inside.assign(scratch_.inside_list.begin(), scratch_.inside_list.end());
        if (!scratch_.outside_list.empty())
            scratch_.outside_list.insert(scratch_.outside_list.end(), lane_count, std::uint16_t(0));
        run_.outside.assign(scratch_.outside_list.begin(), scratch_.outside_list.end());
        run_.halo = scratch_.halo.places();
        return run_.halo.size() <= largest_halo;
    }

private:
    const ParticleCells& cells_;
    const SearchInput& input_;
    NeighbourRun& run_;
    Scratch& scratch_;
    /// Cells as wide as the largest kernel hold many particles of small ones: then candidates are looked
    /// through for groups of particles that stand side by side, and what is left for each of them.
    static constexpr std::size_t many_candidates = 3000;
    static constexpr Index group_length = 64;
    bool anyone_asleep_;

    /// Reaches a little further than it must: positions in single precision, seen from somewhere in the cell,
    /// are wrong by up to a ten-millionth of its edge each.
    Seeker seeker(Index p, const Candidates& candidates) const
    {
        constexpr double rounding = 2e-6;
        const Vec3 offset = input_.motion[p].position - candidates.origin;
        return {static_cast<float>(offset.x), static_cast<float>(offset.y), static_cast<float>(offset.z),
                static_cast<float>(input_.reach[p] + rounding * cells_.side())};
    }

    /// near  a position in the cell
    void collect_candidates(Index cell, const Vec3& near)
    {
        scratch_.inside.clear(near);
        scratch_.outside.clear(near);
        std::array<Index, 27> around;
        const int count = cells_.around(cell, around);
        for (int i = 0; i < count; ++i) {
            const Index first = cells_.begin(around[i]), last = cells_.end(around[i]);
            const Index from = std::clamp(run_.begin, first, last), to = std::clamp(run_.end, first, last);
            const Index copy = cells_.first_copy(around[i]), last_copy = cells_.first_copy(around[i] + 1);
            const Index slot = scratch_.halo.first_slot(cells_, around[i]);
            scratch_.outside.add(input_, first, from, slot);
            if (anyone_asleep_) {
                for (Index p = from; p < to; ++p) {
                    if (input_.asleep[p]) {
                        scratch_.outside.add(input_, p, p + 1, slot + (p - first));
                    } else {
                        scratch_.inside.add(input_, p, p + 1, p - run_.begin);
                    }
                }
            } else {
                scratch_.inside.add(input_, from, to, from - run_.begin);
            }
            scratch_.outside.add(input_, to, last, slot + (to - first));
            scratch_.outside.add(input_, copy, last_copy, slot + (last - first));
        }
    }

    /// The candidates of a cell that particles begin .. end - 1 may reach.
    void narrow_candidates(Index begin, Index end)
    {
        const Seeker first = seeker(begin, scratch_.cell_inside);
        Vector3<float> lower{first.x, first.y, first.z}, upper = lower;
        float reach = 0;
        for (Index p = begin; p < end; ++p) {
            const Seeker at = seeker(p, scratch_.cell_inside);
            lower = {std::min(lower.x, at.x), std::min(lower.y, at.y), std::min(lower.z, at.z)};
            upper = {std::max(upper.x, at.x), std::max(upper.y, at.y), std::max(upper.z, at.z)};
            reach = std::max(reach, at.reach);
        }
        take_near(scratch_.cell_inside, lower, upper, reach, scratch_.inside);
        take_near(scratch_.cell_outside, lower, upper, reach, scratch_.outside);
    }

    /// Lists the neighbours of particles first .. last - 1 among the candidates.
    void list_all(Index first, Index last)
    {
        scratch_.found.resize(std::max(scratch_.inside.count, scratch_.outside.count) + float_count);
        std::size_t own = scratch_.inside.first_from(first - run_.begin);
        for (Index p = first; p < last; ++p) {
            if (!anyone_asleep_ || !input_.asleep[p]) list(p, ++own);
        }
    }

    /// later  the first candidate inside that comes after p
    void list(Index p, std::size_t later)
    {
        const Candidates& inside = scratch_.inside;
        const Seeker own = seeker(p, inside);
        Index* const begin = scratch_.found.data();
        NeighbourRun::Counts& counts = run_.counts[p - run_.begin];

        Index* end = find_close(inside, later, own, begin);
        end = drop_unseen(input_, p, begin, end, [&](Index offset) { return run_.begin + offset; });
        counts.inside = list_inside(p - run_.begin, {begin, end});

        const std::size_t start = scratch_.outside_list.size();
        HaloNumbers& halo = scratch_.halo;
        end = find_close(scratch_.outside, 0, own, begin);
        end = drop_unseen(input_, p, begin, end, [&](Index slot) { return halo.place_of(slot); });
        scratch_.outside_list.resize(start + (end - begin));
        std::transform(begin, end, scratch_.outside_list.begin() + static_cast<std::ptrdiff_t>(start),
                       [&](Index slot) { return halo.number_of(slot); });
        counts.outside = static_cast<std::uint16_t>(end - begin);
    }

    /// Lists pairs with particles that come later in the run, and those that earlier ones have handed over.
    /// What does not fill a pair of batches is handed on: lists without filling save an eighth of all pairs.
    std::uint16_t list_inside(Index own, std::span<const Index> later)
    {
        std::vector<std::uint16_t>& inside = scratch_.inside_list;
        const std::size_t start = inside.size();
        scratch_.handed_over.for_each(own, [&](Index from) { inside.push_back(from); });
        const std::size_t waiting = inside.size(), all = waiting - start + later.size();
        const std::size_t left_over = std::min(all % pair_count, later.size());
        inside.resize(waiting + later.size() - left_over);
        std::uint16_t* listed = inside.data() + waiting;
        for (Index other : later.first(later.size() - left_over)) {
            *listed++ = static_cast<std::uint16_t>(other);
        }
        for (Index other : later.last(left_over)) scratch_.handed_over.add(other, own);
        while (inside.size() % pair_count != 0) inside.push_back(own);
        return static_cast<std::uint16_t>(inside.size() - start);
    }
};

/// Runs of a length that depends on the number of particles alone: long ones hold more pairs inside, but a
/// body must have enough of them to feed many threads.
void cut_runs(Index particles, std::vector<NeighbourRun>& runs)
{
    const Index length = std::clamp<Index>(particles / 16, 256, longest_run);
    runs.resize((particles + length - 1) / length);
    for (std::size_t i = 0; i < runs.size(); ++i) {
        runs[i].begin = static_cast<Index>(i) * length;
        runs[i].end = std::min(particles, runs[i].begin + length);
    }
}

/// A run in two halves, and so on, until their halos fit.
void build_halves(const ParticleCells& cells, const SearchInput& input, const NeighbourRun& whole,
                  Scratch& scratch, std::size_t largest_halo, std::vector<NeighbourRun>& runs)
{
    if (whole.length() == 1) {
        throw RunError(fmt::format("a particle has more than {} neighbours", largest_halo));
    }
    const Index middle = whole.begin + whole.length() / 2;
    for (const auto& [begin, end] : {std::pair{whole.begin, middle}, std::pair{middle, whole.end}}) {
        NeighbourRun half;
        half.begin = begin;
        half.end = end;
        if (RunBuilder(cells, input, half, scratch).build(largest_halo)) {
            runs.push_back(std::move(half));
        } else {
            build_halves(cells, input, half, scratch, largest_halo, runs);
        }
    }
}

} // namespace

void build_neighbours(const ParticleCells& cells, const SearchInput& input, std::vector<NeighbourRun>& runs,
                      std::size_t largest_halo)
{
    cut_runs(static_cast<Index>(input.real_count), runs);
    const auto count = static_cast<std::ptrdiff_t>(runs.size());
    std::vector<char> fits(runs.size());
#pragma omp parallel if (count > 1)
    {
        Scratch scratch;
#pragma omp for schedule(dynamic)
        for (std::ptrdiff_t i = 0; i < count; ++i) {
            fits[i] = RunBuilder(cells, input, runs[i], scratch).build(largest_halo);
        }
    }
    if (std::all_of(fits.begin(), fits.end(), [](char fit) { return fit; })) return;
    std::vector<NeighbourRun> all;
    Scratch scratch;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        if (fits[i]) {
            all.push_back(std::move(runs[i]));
        } else {
            build_halves(cells, input, runs[i], scratch, largest_halo, all);
        }
    }
    runs = std::move(all);
}

} // namespace plash
