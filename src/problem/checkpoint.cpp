// SPDX-License-Identifier: GPL-3.0-or-later
#include "checkpoint.hpp"

#include <spam/core/error.hpp>
#include <spam/io/results.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace spam {
namespace {

std::vector<double> as_numbers(std::span<const double> block) {
    return {block.begin(), block.end()};
}

std::string case_path(std::size_t number) { return fmt::format("/cases/{}", number); }

void write_case(CheckpointWriter& file, const std::string& path, const CaseMemory& one) {
    file.text(path + "/label", one.label);
    file.text(path + "/model", one.model);
    if (!one.has_state()) return;
    file.numbers(path + "/t", std::span(&one.t, 1), 1);
    for (const auto& [name, columns, values] : one.state)
        file.numbers(path + "/state/" + name, values, columns);
    for (const auto& [name, columns, values] : one.particles)
        file.numbers(path + "/particles/" + name, values, columns);
    file.integers(path + "/particles/id", one.id);
    file.integers(path + "/particles/body", one.body);
    file.bytes(path + "/motion", one.motion);
    file.bytes(path + "/records", one.records);
}

CaseMemory read_case(const CheckpointReader& file, const std::string& path) {
    CaseMemory one;
    one.label = file.text(path + "/label");
    one.model = file.text(path + "/model");
    if (!file.has(path + "/t")) return one;
    one.t = file.numbers(path + "/t").at(0);
    one.id = file.integers(path + "/particles/id");
    one.body = file.integers(path + "/particles/body");
    const auto read = [&](const std::string& group, const std::string& name,
                          std::vector<CaseMemory::Values>& into) {
        if (!file.has(path + group + name)) return;
        auto values = file.numbers(path + group + name);
        into.push_back({name, values.size() / std::max<std::size_t>(1, one.id.size()), values});
    };
    for (const Field field :
         {Field::position, Field::velocity, Field::density, Field::stress, Field::energy})
        read("/state/", std::string(field_name(field)), one.state);
    for (const char* name : {"mass", "reference_position"})
        read("/particles/", name, one.particles);
    one.motion = file.bytes(path + "/motion");
    one.records = file.bytes(path + "/records");
    return one;
}

/// "0.1.0" of "0.1.0 (commit ...)": what remembers, and how.
std::string release(const std::string& version) {
    return version.substr(0, version.find_first_not_of("0123456789."));
}

}  // namespace

template <int Dim>
CaseMemory case_memory(const Model<Dim>& model, std::span<const double> y, double t) {
    CaseMemory one;
    one.t = t;
    one.model = model.describe();
    const auto& particles = model.particles();
    for (const auto& block : model.layout().blocks())
        one.state.push_back(
            {std::string(field_name(block.field)), block.components,
             as_numbers(y.subspan(block.offset, block.components * particles.size()))});
    const auto& x = particles.reference_position;
    one.particles = {{"mass", 1, particles.mass},
                     {"reference_position", Dim, {x.data(), x.data() + x.size()}}};
    one.id.assign(particles.id.begin(), particles.id.end());
    one.body.assign(particles.body.begin(), particles.body.end());
    return one;
}

template <int Dim>
std::vector<double> state_of(const CaseMemory& memory, const Model<Dim>& model) {
    const CaseMemory expected = case_memory(model, std::vector<double>(model.layout().size()), 0.0);
    const auto refuse = [](const char* what) {
        throw InputError(
            fmt::format("restart: the checkpoint holds other {} than this case", what));
    };
    if (memory.id != expected.id) refuse("particles");
    const auto same = [](const auto& a, const auto& b) {
        return a.name == b.name && a.values == b.values;
    };
    if (!std::equal(memory.particles.begin(), memory.particles.end(), expected.particles.begin(),
                    expected.particles.end(), same))
        refuse("masses or reference positions");
    const auto alike = [](const auto& a, const auto& b) {
        return a.name == b.name && a.values.size() == b.values.size();
    };
    if (!std::equal(memory.state.begin(), memory.state.end(), expected.state.begin(),
                    expected.state.end(), alike))
        refuse("fields");
    std::vector<double> y;
    for (const auto& field : memory.state)
        y.insert(y.end(), field.values.begin(), field.values.end());
    return y;
}

CheckpointWriter checkpoint_file(const SessionMemory& memory) {
    CheckpointWriter file;
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
    for (std::size_t k = 0; k + 3 < plans.size(); k += 4)
        memory.plans.push_back({plans[k], plans[k + 1], plans[k + 2], plans[k + 3]});
    const auto counts = file.integers("/counts");
    memory.smoke = counts.at(1) != 0;
    memory.on_schedule = counts.at(2) != 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(counts.at(0)); ++k)
        memory.cases.push_back(read_case(file, case_path(k)));
    return memory;
}

template CaseMemory case_memory(const Model<1>&, std::span<const double>, double);
template CaseMemory case_memory(const Model<2>&, std::span<const double>, double);
template CaseMemory case_memory(const Model<3>&, std::span<const double>, double);
template std::vector<double> state_of(const CaseMemory&, const Model<1>&);
template std::vector<double> state_of(const CaseMemory&, const Model<2>&);
template std::vector<double> state_of(const CaseMemory&, const Model<3>&);

}  // namespace spam
