// SPDX-License-Identifier: GPL-3.0-or-later
#include "checkpoint.hpp"
#include "dry_run.hpp"
#include "why_stopped.hpp"
#include <spam/core/error.hpp>
#include <spam/core/instruction_set.hpp>
#include <spam/core/parallel.hpp>
#include <spam/core/program.hpp>
#include <spam/core/text.hpp>
#include <spam/core/threads.hpp>
#include <spam/integrate/interrupt.hpp>
#include <spam/kernel/weight_integrals.hpp>
#include <spam/problem/session.hpp>
#include <spam/processes/processes.hpp>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace spam {
namespace {

/// Started with a closed standard descriptor, the next file opened would take its number and
/// receive what is printed.
void keep_standard_descriptors() {
    for (int fd = 0; fd <= 2; ++fd)
        if (fcntl(fd, F_GETFD) == -1 && open("/dev/null", O_RDWR) < 0) std::abort();
}

/// Of a process whose results are not kept.
const std::filesystem::path& scratch_folder() {
    static const std::filesystem::path folder = make_temporary_folder("spam-rank");
    return folder;
}

InputError too_large() {
    return InputError(
        "not enough memory for this case; give fewer particles, or a shorter range of their weight "
        "function");
}

}  // namespace

Problem::Problem(std::string name, std::string summary, double default_dt, std::string default_step)
    : name_(std::move(name)),
      summary_(std::move(summary)),
      integrator_(default_dt, std::move(default_step)),
      options_(name_, summary_) {
    common_.out = name_ + "-out";
    options_.version(fmt::format("{}: spam {}, SUNDIALS {}", name_, version(), sundials_version()));
    options_.group("Running");
    options_.text("out", common_.out, "result folder");
    options_.flag("force", common_.force, "move an existing result folder aside");
    options_.flag("dry-run", common_.dry_run, "describe the case; compute and write nothing");
    options_.flag("smoke", common_.smoke, "run a short version that takes seconds");
    options_.flag("quiet", common_.quiet, "print errors only");
    options_.flag("no-plots", common_.no_plots, "draw no pictures");
    options_
        .integer(
            "threads", common_.threads,
            "threads for the sums over particles; auto: as many as there are cores, where there "
            "are enough particles to gain by it. Results do not depend on it",
            between(1, 1024))
        .or_word("auto");
    options_.integer("ranks", common_.ranks,
                     "MPI processes that share the particles of a run. Results do not depend on it",
                     between(1, 1024));
    options_.number("t-end", common_.t_end, "time at which the run ends", positive());
    options_.number("output-every", common_.output_every, "time between rows of invariants.csv",
                    positive());
    options_.number("snapshot-every", common_.snapshot_every, "time between snapshots (.vtp)",
                    positive());
    options_.number("checkpoint-every", common_.checkpoint_every,
                    "time between checkpoints, written to checkpoint_0.h5 and checkpoint_1.h5 in "
                    "turn; one is always written at the end",
                    positive());
    options_.text("restart", common_.restart,
                  "continue from a checkpoint file with its case, or from the last scheduled "
                  "checkpoint of a result folder");
    options_.exclude_from_case(
        {"out", "force", "dry-run", "smoke", "quiet", "no-plots", "threads", "ranks", "restart"});
    options_.case_from(
        "restart", [this](const std::string& file) { return recall_case(file); },
        {"t-end", "output-every", "snapshot-every", "checkpoint-every", "max-steps"});
    integrator_.add_to(options_);
    add_guard_options();
    options_.group("Problem");
}

Problem::~Problem() = default;

/// As many as there are.
void Problem::settle_ranks() {
    const auto wanted = static_cast<std::size_t>(common_.ranks.value_or(1));
    if (wanted > 1 && !why_one_process().empty()) throw InputError("ranks: " + why_one_process());
    if (common_.ranks && wanted != processes().count())
        throw InputError(fmt::format(
            "ranks: {} processes are asked for, and the number running is {}; give --ranks on the command line, which "
            "starts the processes (a file of options cannot), or leave it out",
            wanted, processes().count()));
    if (!muted()) return;
    common_.out = scratch_folder() / "out";
    common_.force = false;
    common_.no_plots = true;
}

void Problem::units(UnitNames units) {
    units_ = std::move(units);
    options_.unit({"t-end", "output-every", "snapshot-every", "checkpoint-every", "dt", "min-step",
                   "max-step", "initial-step"},
                  units_.named() ? units_.time : "reduced units");
    options_.footer("Units: " + units_.describe());
}

void Problem::add_guard_options() {
    auto& guard = common_.guard;
    options_.group("Guard");
    options_.choice<DriftAction>("guard", guard.action,
                                 {DriftAction::off, DriftAction::warn, DriftAction::stop},
                                 "what to do when an invariant changes by more than its limit");
    const auto limit = [&](const char* name, std::optional<double>& target) {
        options_.number(
            std::string("limit-") + name, target,
            "largest relative change before the guard reacts (default: the scheme's bound)",
            positive());
    };
    limit("momentum", guard.momentum);
    limit("angular-momentum", guard.angular_momentum);
    limit("energy", guard.energy);
    const auto& all = guard_option_names();
    options_.only_when(
        {all.begin() + 1, all.end()}, {"guard"},
        [&guard] { return guard.action != DriftAction::off; },
        "has no meaning with --guard off; use --guard warn or stop");
}

const std::vector<std::string>& Problem::guard_option_names() {
    static const std::vector<std::string> names{"guard", "limit-momentum", "limit-angular-momentum",
                                                "limit-energy"};
    return names;
}

const std::vector<std::string>& Problem::scheme_option_names() {
    static const std::vector<std::string> names{
        "density", "transport",      "mean-density", "angular-momentum",
        "balance", "gauss-singular", "viscosity",    "closest-approach"};
    return names;
}

double step_of_short_range(double range, double usual) {
    // No shorter than a quarter: ranges below the spacing are refused elsewhere, by name.
    const double part = std::clamp(1.5 * range / usual, 0.5, 1.0);
    return part * part;
}

void Problem::use_scheme(const Scheme& standard) {
    scheme_ = standard;
    standard_kernel_ = standard.kernel;
    standard_range_ = standard.range;
    options_.group("Weight function");
    options_.choice<Kernel>("kernel", scheme_.kernel, all_kernels(),
                            "weight function; where it is steeper than the default, so is the "
                            "default step shorter");
    options_.number(
        "range", scheme_.range,
        "distance at which the weight function vanishes; below two thirds of the default, "
        "the default step is shorter",
        positive());
    options_.group("Scheme");
    options_.choice<Density>("density", scheme_.density,
                             {Density::continuity, Density::summed, Density::chain_rule},
                             "how the density is computed: by the continuity equation, as a sum "
                             "over neighbours, or by the chain rule with the transport velocity");
    options_.choice<Transport>(
        "transport", scheme_.transport, {Transport::plain, Transport::average, Transport::monaghan},
        "velocity that moves the particles: v, the average <v>, or Monaghan's average");
    options_.choice<MeanDensityKind>("mean-density", scheme_.mean_density,
                                     {MeanDensityKind::arithmetic, MeanDensityKind::geometric},
                                     "mean density rho_ij of a pair");
    options_.choice<AngularMomentum>(
        "angular-momentum", scheme_.angular_momentum,
        {AngularMomentum::free, AngularMomentum::gauss, AngularMomentum::torque_particle,
         AngularMomentum::torque_pair},
        "what is done about the angular momentum: nothing, Gauss' principle, or balanced torques "
        "of particles or pairs");
    options_.choice<Balance>(
        "balance", scheme_.balance, {Balance::body, Balance::global},
        "what conserves its angular momentum: every body by itself, or all bodies together");
    options_.choice<GaussSingular>(
        "gauss-singular", scheme_.gauss_singular, {GaussSingular::skip, GaussSingular::stop},
        "where Gauss' denominator vanishes: continue without the constraint, or stop");
    options_.number("viscosity", scheme_.viscosity,
                    "coefficient alpha of von Neumann's artificial viscosity; 0 for none",
                    non_negative());
    options_.number("closest-approach", scheme_.closest_approach,
                    "distance at which approaching pairs are reflected; 0 for no reflection",
                    non_negative());
    options_.only_when(
        {"balance"}, {"angular-momentum"},
        [this] { return scheme_.angular_momentum != AngularMomentum::free; },
        "has no meaning with {by}; it needs gauss, torque_particle or torque_pair");
    options_.only_when(
        {"gauss-singular"}, {"angular-momentum"},
        [this] { return scheme_.angular_momentum == AngularMomentum::gauss; },
        "has no meaning with {by}; it needs gauss");
    options_.group("Problem");
}

int Problem::complain(const std::exception& error, int status) const {
    // fputs, not fmt::print: nothing to throw when standard error is closed.
    std::fputs(fmt::format("{}: {}\n", name_, one_line(error.what())).c_str(), stderr);
    return status;
}

/// With --ranks this process starts others, and waits. Each of these does what one alone would do (PartedMotion), but
/// the first alone has a terminal and a result folder; others write into a folder of their own that is not kept.
int Problem::main(int argc, char** argv, const std::function<void(Session&)>& body) {
    keep_standard_descriptors();
    try {
        const std::size_t ranks = ranks_asked_for(argc, argv);
        if (ranks > 1 && !started_with_others() && why_one_process().empty())
            return start_processes(ranks, argv);
        if (started_with_others()) processes_ = join_processes();
    } catch (const InputError& error) {
        return complain(error, 2);
    } catch (const OutputError& error) {
        return complain(error, 4);
    }
    if (!muted()) {
        const int status = run(argc, argv, body);
        return processes().alone() ? status : report_status(status);
    }
    if (const int null = open("/dev/null", O_WRONLY); null >= 0)
        for (const int fd : {STDOUT_FILENO, STDERR_FILENO}) dup2(null, fd);
    run(argc, argv, body);
    try {
        std::filesystem::remove_all(scratch_folder());
    } catch (const std::exception&) {  // the run has said that there is none
    }
    return 0;
}

int Problem::run(int argc, char** argv, const std::function<void(Session&)>& body) {
    std::string command = name_;
    for (int k = 1; k < argc; ++k) command += fmt::format(" {}", argv[k]);
    const InterruptWatch watch(name_);
    try {
        if (!options_.parse(argc, argv)) return 0;
        settle_ranks();
        settle_restart();
        instruction_set();  // a wrong SPAM_ISA or SPAM_AHEAD is refused like a wrong option
        options_.settle();
        relative_step_ = step_of_short_range(scheme_.range, standard_range_);
        if (scheme_.kernel != standard_kernel_) {
            const auto weight = [](Kernel k) { return weight_function<2>(to_string(k), 1.0); };
            relative_step_ *= relative_step<2>(weight(scheme_.kernel), weight(standard_kernel_));
        }
        if (relative_step_ < 1.0) integrator_.shorten_default(relative_step_);
        IntegratorOptions integrator;
        std::exception_ptr refused;  // of no account where nothing is integrated
        try {
            integrator = integrator_.resolve(options_);
        } catch (const InputError&) {
            refused = std::current_exception();
        }
        start_threads(common_.threads.value_or(1));
        Session session(*this, integrator, refused, command);
        try {
            body(session);
        } catch (const DryRunDone&) {
            return 0;
        } catch (const PartLeft&) {
            throw;
        } catch (const Interrupted&) {
            if (!session.folder_) throw;  // else the session says so
        } catch (...) {
            // Once there are results the input has been accepted: what fails then is the run.
            const std::string reason = session.folder_ ? why_a_run_stops() : "";
            if (reason.empty()) throw;
            throw GuardStop(reason);
        }
        const int status = session.finish();
        processes().agree();
        return status;
    } catch (const PartLeft& error) {
        return complain(error, 4);
    } catch (...) {
        return refusal();
    }
}

/// The exit status of the exception just caught, with its line on standard error. Other processes are told, so that
/// they end too.
int Problem::refusal() const {
    try {
        try {
            throw;
        } catch (const std::exception& error) {
            processes().leave(error.what());
            throw;
        }
    } catch (const InputError& error) {
        return complain(error, 2);
    } catch (const GuardStop& error) {
        return complain(error, 3);
    } catch (const OutputError& error) {
        return complain(error, 4);
    } catch (const std::bad_alloc&) {
        return complain(too_large(), 2);
    } catch (const std::length_error&) {
        return complain(too_large(), 2);
    } catch (const std::system_error& error) {  // files: std::filesystem and streams
        return complain(error, 4);
    } catch (const std::exception& error) {
        return complain(std::runtime_error(fmt::format(
                            "a defect of this program, not of its input or its results: {}; "
                            "please report it with the command",
                            error.what())),
                        4);
    }
}

}  // namespace spam
