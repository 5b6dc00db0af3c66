// SPDX-License-Identifier: GPL-3.0-or-later
#include "checkpoint.hpp"

#include <spam/core/error.hpp>
#include <spam/io/results.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace spam {
namespace {

std::string case_path(std::size_t number) { return fmt::format("/cases/{}", number); }

void write_case(CheckpointWriter& file, const std::string& path, const CaseMemory& one) {
    file.text(path + "/label", one.label);
    file.text(path + "/model", one.model);
    if (!one.has_state()) return;
    file.numbers(path + "/t", std::span(&one.t, 1), 1);
    std::string fields;  // in the order of y
    for (const auto& block : one.state) {
        file.numbers(path + "/state/" + block.name, block.values.all(), block.columns);
        fields += block.name + "\n";
    }
    file.text(path + "/fields", fields);
    for (const auto& block : one.particles)
        file.numbers(path + "/particles/" + block.name, block.values.all(), block.columns);
    file.integers(path + "/particles/id", one.id.all());
    file.integers32(path + "/particles/body", one.body);
    if (!one.material.empty()) file.integers32(path + "/particles/material", one.material);
    file.bytes(path + "/motion", one.motion);
    file.bytes(path + "/records", one.records);
}

[[noreturn]] void refuse_contents(const std::string& path) {
    throw InputError(fmt::format(
        "what the checkpoint holds at '{}' is nothing that a run writes; use another checkpoint",
        path));
}

CaseMemory read_case(const CheckpointReader& file, const std::string& path) {
    CaseMemory one;
    one.label = file.text(path + "/label");
    one.model = file.text(path + "/model");
    if (!file.has(path + "/t")) return one;
    const auto t = file.numbers(path + "/t");
    if (t.size() != 1 || !(t[0] >= 0.0) || !std::isfinite(t[0])) refuse_contents(path + "/t");
    one.t = t[0];
    one.id.kept = file.integers(path + "/particles/id");
    const auto body = file.integers(path + "/particles/body");
    one.body.assign(body.begin(), body.end());
    if (file.has(path + "/particles/material")) {
        const auto material = file.integers(path + "/particles/material");
        one.material.assign(material.begin(), material.end());
    }
    const auto read = [&](const std::string& group, const std::string& name,
                          std::vector<CaseMemory::Values>& into) {
        into.push_back(
            {name, file.columns(path + group + name), {{}, file.numbers(path + group + name)}});
    };
    std::istringstream fields(file.text(path + "/fields"));
    for (std::string name; std::getline(fields, name);) read("/state/", name, one.state);
    for (const char* name : {"mass", "reference_position"})
        read("/particles/", name, one.particles);
    one.motion = file.bytes(path + "/motion");
    one.records = file.bytes(path + "/records");
    return one;
}

/// Bytes that it fills in a file.
std::size_t size_of(const CaseMemory& one) {
    std::size_t bytes = one.motion.size() + one.records.size() + 16 * one.body.size();
    for (const auto* blocks : {&one.state, &one.particles})
        for (const auto& block : *blocks) bytes += block.values.all().size_bytes();
    return bytes;
}

/// "0.1.0" of "0.1.0 (commit ...)": what remembers, and how.
std::string release(const std::string& version) {
    return version.substr(0, version.find_first_not_of("0123456789."));
}

}  // namespace

void CaseMemory::keep() {
    for (Values& block : particles) block.values.keep();
    id.keep();
}

namespace {

template <int Dim>
CaseMemory memory_of(const Particles<Dim>& particles) {
    CaseMemory one;
    const auto& x = particles.reference_position;
    one.particles = {{"mass", 1, {particles.mass}},
                     {"reference_position", Dim, {{x.data(), static_cast<std::size_t>(x.size())}}}};
    one.id = {particles.id};
    one.body = particles.body;
    return one;
}

}  // namespace

template <int Dim>
CaseMemory case_memory(const Model<Dim>& model, std::span<const double> y, double t) {
    CaseMemory one = memory_of(model.particles());
    one.t = t;
    one.model = model.describe();
    for (const auto& block : model.layout().blocks()) {
        const auto values = y.subspan(block.offset, block.size);
        one.state.push_back({block.name(), block.components, {values}});
        one.state.back().values.keep();
    }
    return one;
}

template <int Dim>
std::vector<double> state_of(const CaseMemory& memory, const Model<Dim>& model) {
    const CaseMemory expected = memory_of(model.particles());
    const auto refuse = [](const char* what) {
        throw InputError(
            fmt::format("restart: the checkpoint holds other {} than this case", what));
    };
    if (!std::ranges::equal(memory.id.all(), expected.id.all())) refuse("particles");
    const auto same = [](const auto& a, const auto& b) {
        return a.name == b.name && std::ranges::equal(a.values.all(), b.values.all());
    };
    if (!std::equal(memory.particles.begin(), memory.particles.end(), expected.particles.begin(),
                    expected.particles.end(), same))
        refuse("masses or reference positions");
    const auto& blocks = model.layout().blocks();
    const auto alike = [&](const auto& a, const auto& b) {
        return a.name == b.name() && a.values.all().size() == b.size;
    };
    if (!std::equal(memory.state.begin(), memory.state.end(), blocks.begin(), blocks.end(), alike))
        refuse("fields");
    std::vector<double> y;
    y.reserve(model.layout().size());
    for (const auto& field : memory.state)
        y.insert(y.end(), field.values.all().begin(), field.values.all().end());
    return y;
}

template <int Dim>
void revive(Case<Dim>& one, const CaseMemory& memory) {
    const Particles<Dim>& first = one.model->particles();
    if (!one.plan.rezoning || std::ranges::equal(memory.id.all(), first.id)) return;
    const auto mass = memory.particles[0].values.all(), place = memory.particles[1].values.all();
    const auto id = memory.id.all();
    const std::size_t n = mass.size();
    const auto good = [](double x) { return std::isfinite(x); };
    if (n == 0 || id.size() != n || memory.body.size() != n || place.size() != Dim * n ||
        memory.material.size() != (first.material.empty() ? 0 : n) ||
        !std::ranges::all_of(mass, [&](double m) { return m > 0.0 && good(m); }) ||
        !std::ranges::all_of(place, good))
        throw InputError("restart: the checkpoint holds what are no particles of this case");
    Particles<Dim> particles{
        {mass.begin(), mass.end()},
        {id.begin(), id.end()},
        memory.body,
        Eigen::Map<const Points<Dim>>(place.data(), Dim, static_cast<Eigen::Index>(n)),
        first.spacing,
        memory.material};
    auto model = one.plan.rezoning->make(std::move(particles));
    model->take_scales(*one.model);
    one.y0 = state_of(memory, *model);
    one.model = std::move(model);
}

CheckpointWriter checkpoint_file(const SessionMemory& memory) {
    std::size_t expected = 0;
    for (const CaseMemory& one : memory.cases) expected += size_of(one);
    CheckpointWriter file(expected);
    file.text("/version", memory.version);
    file.text("/instruction_set", memory.instruction_set);
    file.text("/problem", memory.problem);
    file.text("/case", memory.case_toml);
    file.text("/command", memory.command);
    const std::int64_t counts[] = {static_cast<std::int64_t>(memory.cases.size()), memory.smoke,
                                   memory.on_schedule};
    file.integers("/counts", counts);
    std::vector<double> plans;
    for (const PlanMemory& plan : memory.plans)
        plans.insert(plans.end(),
                     {plan.t_end, plan.output_every, plan.snapshot_every, plan.checkpoint_every});
    file.numbers("/plans", plans, 4);
    for (std::size_t k = 0; k < memory.cases.size(); ++k)
        write_case(file, case_path(k), memory.cases[k]);
    return file;
}

SessionMemory read_checkpoint(const std::filesystem::path& path) {
    const CheckpointReader file(path);
    SessionMemory memory;
    memory.version = file.text("/version");
    if (release(memory.version) != release(version()))
        throw InputError(fmt::format("'{}' was written by spam {}, this is {}; use that version",
                                     path.string(), memory.version, version()));
    memory.instruction_set = file.text("/instruction_set");
    memory.problem = file.text("/problem");
    memory.case_toml = file.text("/case");
    memory.command = file.text("/command");
    const auto plans = file.numbers("/plans");
    // Times that are no intervals, or have a million million in a run, would never come to their end.
    if (file.columns("/plans") != 4) refuse_contents("/plans");
    for (std::size_t k = 0; k + 3 < plans.size(); k += 4) {
        for (std::size_t m = k; m < k + 4; ++m)
            if (!(plans[m] >= 1e-12 * plans[k]) || !(plans[m] > 0.0) || !std::isfinite(plans[m]))
                refuse_contents("/plans");
        memory.plans.push_back({plans[k], plans[k + 1], plans[k + 2], plans[k + 3]});
    }
    const auto counts = file.integers("/counts");
    if (counts.size() != 3 || counts[0] < 0) refuse_contents("/counts");
    memory.smoke = counts[1] != 0;
    memory.on_schedule = counts[2] != 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(counts[0]); ++k)
        memory.cases.push_back(read_case(file, case_path(k)));
    return memory;
}

#define SPAM_INSTANTIATE(D)                                                            \
    template CaseMemory case_memory(const Model<D>&, std::span<const double>, double); \
    template std::vector<double> state_of(const CaseMemory&, const Model<D>&);         \
    template void revive(Case<D>&, const CaseMemory&);
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam
