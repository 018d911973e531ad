#pragma once

#include "contact/move_penetrating.h"
#include "parser/read_model.h"
#include "solver/explicit_loop.h"
#include "solver/scene.h"
#include "tests/support/contact_model.h"
#include "tests/support/deck_text.h"
#include "tests/support/momenta.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <fstream>
#include <memory>

namespace plash::testing {

/// A deck that has been read and set up; Watch terms may be added before it runs.
struct DeckRun {
    std::unique_ptr<ReadResult> read;
    std::vector<MovedNode> moved; ///< out of surfaces before the start
    std::unique_ptr<Scene> scene;
    Outcome outcome;

    explicit DeckRun(const std::string& text)
    {
        const TemporaryFolder folder;
        std::ofstream(folder / "deck.k") << text;
        read = std::make_unique<ReadResult>(read_model(folder / "deck.k"));
        EXPECT_TRUE(read->ok) << messages();
        EXPECT_TRUE(unsupported_keywords(read->report).empty()) << messages();
        if (!read->ok) return;
        moved = move_penetrating_nodes(read->model);
        scene = std::make_unique<Scene>(make_scene(read->model));
    }

    std::string messages() const
    {
        std::string all;
        for (const auto& message : read->report.errors) all += message.text + "\n";
        return all;
    }

    void watch(std::function<void(const Clock&, const State&)> look)
    {
        scene->terms.push_back(std::make_unique<Watch>(std::move(look)));
    }

    void go()
    {
        Recorders nothing;
        outcome = run(*scene, nothing);
        EXPECT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    }

    template <class Wanted>
    Wanted* find() const
    {
        for (const auto& term : scene->terms) {
            if (auto* wanted = dynamic_cast<Wanted*>(term.get())) return wanted;
        }
        return nullptr;
    }
    Index node(Id id) const
    {
        const auto& ids = scene->model.nodes.id;
        return static_cast<Index>(std::find(ids.begin(), ids.end(), id) - ids.begin());
    }
};

} // namespace plash::testing
