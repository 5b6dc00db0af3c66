// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation.hpp"

#include "../problem/run.hpp"
#include <spam/core/error.hpp>
#include <spam/core/parallel.hpp>
#include <spam/core/threads.hpp>
#include <spam/problem/integrator_settings.hpp>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <cmath>
#include <numeric>

namespace spam::python {
namespace {

double number_of(const py::object& value, const char* what) {
    const double number = PyFloat_AsDouble(value.ptr());
    if (number == -1.0 && PyErr_Occurred()) {
        if (!PyErr_ExceptionMatches(PyExc_TypeError)) throw py::error_already_set();
        PyErr_Clear();
        throw InputError(fmt::format("{}: returned {}, which is no number", what,
                                     std::string(py::str(py::type::of(value).attr("__name__")))));
    }
    return number;
}

}  // namespace

/// Of computing: one at a time, by the latest Simulation of the model, in this process.
template <int Dim>
class Simulation<Dim>::Turn {
  public:
    explicit Turn(Simulation& simulation)
        : simulation_(simulation),
          use_(std::make_unique<Use>(*simulation.held())) {
        if (use_->nested())
            throw std::runtime_error(
                "a simulation of the model is running; this call comes from inside its run");
        if (simulation.held()->moved_by != &simulation)
            throw std::runtime_error(
                "the model goes on in another Simulation, which was made of it later; make a model for each");
        set_threads(simulation.threads_);
    }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;
    /// It goes on with this model.
    void pass_to(HeldModel<Dim>& held) {
        use_ = std::make_unique<Use>(held);
        held.moved_by = &simulation_;
    }

  private:
    using Use = typename HeldModel<Dim>::Use;
    Simulation& simulation_;
    std::unique_ptr<Use> use_;
};

template <int Dim>
Simulation<Dim>::Simulation(std::shared_ptr<HeldModel<Dim>> model, const py::object& y0,
                            const IntegratorOptions& options, double t0, int threads)
    : options_(options),
      threads_(checked_threads(threads)) {
    PartedMotion<Dim>::refuse(*model->model, options, processes());
    // Processes share cores: threads beside them are asked for.
    if (threads_ == 0) threads_ = processes().alone() ? usable_cores() : 1;
    now_ = std::make_shared<OnItsWay>(model, model->checked(y0), options, t0);
    held()->moved_by = this;
}

template <int Dim>
void Simulation<Dim>::refuse_earlier() const {
    if (!now_->motion.processes().alone() && latest_on_its_way != now_.get())
        throw InputError(
            "simulation: processes share the particles of one Simulation at a time, and a later one has been made; "
            "end the earlier one before");
}

template <int Dim>
std::vector<std::uint32_t> Simulation<Dim>::own() const {
    refuse_earlier();
    const auto numbers = processes().numbers();
    std::vector<std::uint32_t> own(numbers.begin(), numbers.end());
    if (own.empty()) {
        own.resize(held()->size());
        std::iota(own.begin(), own.end(), 0U);
    }
    return own;
}

template <int Dim>
void Simulation<Dim>::together(const std::function<void()>& f) {
    refuse_earlier();
    Parts& all = now_->motion.processes();
    try {
        const py::gil_scoped_release others;
        const Parts::Here here(all);
        f();
    } catch (const PartGaveUp& other) {
        throw GuardStop(fmt::format("another process has stopped: {}", other.what()));
    } catch (const PartLeft&) {
        throw;
    } catch (const GuardStop& stop) {
        all.give_up(stop.what());
        held()->pending->raise();
        throw;
    } catch (const std::exception& error) {
        const std::string what = error.what();  // of Python's, lines of where it was follow
        all.give_up(what.substr(0, what.find('\n')));
        throw;
    }
}

template <int Dim>
void Simulation<Dim>::watch(double t) {
    for (const Remark& remark : now_->motion.watch()) {
        remarks_.emplace_back(t, remark);
        if (remark.stop)
            throw GuardStop(fmt::format("{} ({:.3g}) at t = {:.6g}", remark.what, remark.value, t));
    }
}

/// Of a step that has been accepted although a function failed in it nothing is kept back: it ends here.
template <int Dim>
void Simulation<Dim>::look_after(double t, Signals& signals) {
    if (held()->pending->failed()) throw GuardStop("a function of Python has failed");
    refuse_earlier();  // a function of the script may have made one
    watch(t);
    signals.look();
}

template <int Dim>
double Simulation<Dim>::step(double t_stop) {
    if (!(t_stop > t()))
        throw InputError(fmt::format("t_stop: {} is not after t = {}", t_stop, t()));
    const Turn turn(*this);
    Signals signals;
    together([&] {
        now_->motion.integrator().step(t_stop);
        look_after(t(), signals);
    });
    return t();
}

template <int Dim>
Observers Simulation<Dim>::observers(const RunRequest& request, Signals& signals) {
    const auto calls = [this](const py::object& f) -> std::function<void(double)> {
        if (f.is_none()) return {};
        return [this, call = f.ptr()](double) {
            const py::gil_scoped_acquire interpreter;
            const typename HeldModel<Dim>::Break pause(*held());
            py::reinterpret_borrow<py::object>(call)();
        };
    };
    const auto asks = [this](const py::object& f) -> std::function<bool(double)> {
        if (f.is_none()) return {};
        return [this, call = f.ptr()](double) {
            const py::gil_scoped_acquire interpreter;
            const typename HeldModel<Dim>::Break pause(*held());
            const py::object answer = py::reinterpret_borrow<py::object>(call)();
            const int truth = PyObject_IsTrue(answer.ptr());
            if (truth < 0) throw py::error_already_set();
            return truth == 1;
        };
    };
    Observers observers;
    observers.output = [this, on_row = calls(request.on_row)](double t) {
        recorder_->add(t, now_->motion.statistics().last_step, now_->motion.y());
        if (on_row) on_row(t);
    };
    observers.snapshot = calls(request.on_snapshot);
    observers.step = [this, &signals](double t) { look_after(t, signals); };
    observers.revise = asks(request.revise);
    observers.enough = asks(request.enough);
    return observers;
}

/// Limits that make no sense and laws that cannot be split are refused before anything is computed.
template <int Dim>
void Simulation<Dim>::prepare(const RezoningChoice& choice) {
    Rezoning<Dim> how = choice.of<Dim>();
    how.memory = rezoned_;
    how.make = [this](Particles<Dim> particles) -> std::shared_ptr<Model<Dim>> {
        const py::gil_scoped_acquire interpreter;  // models share functions of Python
        made_ = held()->again(std::move(particles));
        return made_->model;
    };
    how.check(*held()->model);
    if (!held()->again)
        throw InputError(
            "rezone: this model cannot be made of other particles; use SmoothParticles()");
    plan_.rezone(std::move(how));
}

/// As Run::rezone: what goes on is what a checkpoint would hold. Without the interpreter where rates may be found:
/// other threads of a right-hand side wait for it.
template <int Dim>
void Simulation<Dim>::rezone(double t, Turn& turn) {
    auto next = plan_.rezoning->change(*held()->model, now_->motion.y());
    if (!next) return;
    made_->made_in_a_run();
    const auto then = std::make_shared<OnItsWay>(std::move(made_), next->y, options_, t);
    then->motion.go_on_from(now_->motion);
    pairs_before_ += now_->motion.pair_interactions();
    {
        const py::gil_scoped_acquire interpreter;  // of what has been, functions of Python may go
        turn.pass_to(*then->held);
        now_ = then;
    }
    recorder_->go_on_with(*held()->model);
    for (const Remark& remark : next->remarks) remarks_.emplace_back(t, remark);
}

template <int Dim>
void Simulation<Dim>::run(const RunRequest& request) {
    if (!std::isfinite(request.t_end) || request.t_end <= t())
        throw InputError(fmt::format("t_end: {} is not after t = {}", request.t_end, t()));
    for (const double interval : {request.every, request.snapshot_every})
        if (!std::isfinite(interval) || interval <= 0.0)
            throw InputError(
                fmt::format("every: {} is not allowed; use a positive time", interval));
    refuse_endless(options_, request.t_end - t());
    Turn turn(*this);
    plan_ = {};
    if (request.rezone) prepare(*request.rezone);
    std::vector<Column<Dim>> columns;
    for (const auto& [name, f] : request.columns)
        columns.push_back({name, [this, call = f.ptr(), what = "columns: " + name](
                                     const Model<Dim>&, std::span<const double>) {
                               const py::gil_scoped_acquire interpreter;
                               const typename HeldModel<Dim>::Break pause(*held());
                               return number_of(py::reinterpret_borrow<py::object>(call)(),
                                                what.c_str());
                           }});
    plan_.record(std::move(columns));
    recorder_ = std::make_unique<Recorder<Dim>>(*held()->model, plan_, nullptr);
    if (const auto dt = symplectic_step(options_)) recorder_->expect_swing(*dt, *held()->model);
    remarks_.clear();
    Signals signals;
    const Schedule schedule{.t_end = request.t_end,
                            .output_every = request.every,
                            .snapshot_every = request.snapshot_every,
                            .change_every = request.rezone ? request.rezone->every : 0.0,
                            .start = t()};
    Observers all = observers(request, signals);
    if (request.rezone) all.change = [&](double at) { rezone(at, turn); };
    all = of_the_whole(std::move(all));
    together([&] {
        drive([this]() -> Integrator& { return now_->motion.integrator(); }, schedule, all);
    });
}

template <int Dim>
void Simulation<Dim>::replace(const py::dict& fields) {
    const typename HeldModel<Dim>::Use use(*held());
    const auto present = this->y();
    std::vector<double> y(present.begin(), present.end());
    for (const auto& [key, value] : fields) {
        const std::string name = py::str(key);
        const auto& blocks = held()->model->layout().blocks();
        const auto block = std::find_if(blocks.begin(), blocks.end(),
                                        [&](const auto& one) { return one.name() == name; });
        if (block == blocks.end()) throw InputError(fmt::format("edit: y has no field '{}'", name));
        const Doubles given = doubles_of(value, name);
        if (static_cast<std::size_t>(given.size()) != block->size)
            throw InputError(fmt::format("{}: has {} numbers, and should have {}", name,
                                         given.size(), block->size));
        std::copy_n(given.data(), block->size,
                    y.begin() + static_cast<std::ptrdiff_t>(block->offset));
    }
    // Inside a run the driver lets the integrator begin anew, after revise().
    if (!use.nested() && held()->moved_by != this)
        throw std::runtime_error("the model goes on in another Simulation; make a model for each");
    now_->motion.edit([&](std::span<double> now) {
        std::copy(y.begin(), y.end(), now.begin());
        return true;
    });
}

template <int Dim>
py::object Simulation<Dim>::rows() const {
    if (!recorder_) return py::none();
    const typename HeldModel<Dim>::Use use(*held());
    const History& history = recorder_->history();
    const auto columns = static_cast<py::ssize_t>(history.names().size());
    Doubles all({static_cast<py::ssize_t>(history.rows().size()), columns});
    double* to = all.mutable_data();
    for (const auto& row : history.rows()) to = std::copy(row.begin(), row.end(), to);
    return py::make_tuple(py::cast(history.names()), all);
}

template <int Dim>
py::list Simulation<Dim>::drifts() const {
    py::list drifts;
    if (!recorder_) return drifts;
    const typename HeldModel<Dim>::Use use(*held());
    for (const Drift& one : recorder_->drifts(promise_limit(options_, *held()->model)))
        drifts.append(py::make_tuple(one.name, std::string(to_string(one.promise)), one.scale,
                                     one.limit, one.change, one.kept()));
    return drifts;
}

template <int Dim>
py::list Simulation<Dim>::remarks() const {
    const typename HeldModel<Dim>::Use use(*held());
    py::list list;
    for (const auto& [t, remark] : remarks_)
        list.append(py::make_tuple(t, remark.what, remark.value));
    return list;
}

template <int Dim>
py::dict Simulation<Dim>::statistics() const {
    refuse_earlier();
    const auto& s = now_->motion.statistics();
    return py::dict(
        py::arg("steps") = s.steps, py::arg("rejected_steps") = s.rejected_steps,
        py::arg("rhs_evaluations") = s.rhs_evaluations, py::arg("events") = s.events,
        py::arg("last_step") = s.last_step,
        py::arg("pair_interactions") = pairs_before_ + now_->motion.pair_interactions());
}

SPAM_COMPILED(template class Simulation);

}  // namespace spam::python
