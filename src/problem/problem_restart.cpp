// SPDX-License-Identifier: GPL-3.0-or-later
// What --restart means: the case, and the folder of results.
#include "checkpoint.hpp"
#include <spam/core/error.hpp>
#include <spam/problem/problem.hpp>

#include <fmt/format.h>

#include <chrono>
#include <filesystem>

namespace spam {

/// The case of a checkpoint; keeps the rest of it for the session. No run may be at work in its folder.
std::string Problem::recall_case(const std::string& name) {
    namespace fs = std::filesystem;
    std::string file = name;
    std::error_code error;
    const bool is_folder = fs::is_directory(name, error);
    fs::path folder = (is_folder ? fs::path(name) / "run.log" : fs::path(name)).parent_path();
    if (folder.empty()) folder = ".";
    // Held before anything in it is read: else another run could put its results in place of these between
    // reading and going on. A process that only reads a checkpoint lets go of it soon.
    constexpr std::chrono::seconds patience{1};
    if (!muted() && fs::exists(folder / "run.log", error))
        restarted_ = RunFolder::reopen(folder, patience);
    processes().agree();  // the first one holds it for all
    if (is_folder) {
        const auto newest = newest_checkpoint(name);
        if (!newest)
            throw InputError(fmt::format(
                "restart: '{}' holds no complete checkpoint; give the folder of a run that has "
                "written one, or a checkpoint file",
                name));
        file = newest->string();
        if (!restarted_ && !muted())
            throw InputError(fmt::format(
                "restart: '{}' is no folder of results any more (it has no run.log); give its "
                "checkpoint, --restart {}, and another --out",
                name, file));
    }
    restart_file_ = file;
    try {
        earlier_ = std::make_unique<SessionMemory>(read_checkpoint(file));
    } catch (const InputError& refusal) {
        throw InputError(fmt::format("restart: {}", refusal.what()));
    }
    if (earlier_->problem != name_)
        throw InputError(fmt::format(
            "restart: '{}' is a checkpoint of {}, not of {}; go on with ./spam run {} --restart ...",
            file, earlier_->problem, name_, earlier_->problem));
    return earlier_->case_toml;
}

/// A run that is gone on with does so in the folder of its results, unless another is named.
void Problem::settle_restart() {
    if (!earlier_) return;
    namespace fs = std::filesystem;
    common_.restart = restart_file_;
    if (common_.smoke && !earlier_->smoke)
        throw InputError("smoke: --restart goes on with the same case, which was no smoke test");
    common_.smoke = earlier_->smoke;
    if (!restarted_) return;
    const fs::path& folder = restarted_->path();
    std::error_code error;
    if (!options_.given("out")) common_.out = folder.string();
    const bool in_place = fs::equivalent(common_.out, folder, error) && !error;
    if (in_place && common_.force)
        throw InputError(
            "force: --restart goes on in the folder of its checkpoint; leave --force out, or "
            "choose another --out");
    if (in_place) {
        restarted_->check_own();
        reopened_ = restarted_;
    } else {
        restarted_->release();  // several may go on from it, each elsewhere
    }
}

}  // namespace spam
